#include "common/yarp/state_message.h"

#include <bit>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "common/yarp/yarp_error.h"
#include "tests/yarp/wire_bytes.h"

namespace puck {
namespace {

using namespace std::string_literals;

// The envelope of `text`, its NUL included.
std::string envelope(const std::string& text) {
  Bytes length;
  append_int(length, static_cast<int>(text.size()));
  return as_text(length) + "~\0\0\1"s + text;
}

std::string encoders(std::initializer_list<double> deg) {
  Bytes bytes;
  append_int(bytes, 266);
  append_int(bytes, static_cast<int>(deg.size()));
  for (const double value : deg) append_real(bytes, value);
  return as_text(bytes);
}

const std::string kStamp = envelope("D 12 1795247365.76\0"s);

StateMessage parse(const std::string& text) { return parse_state_message(wire(text)); }

}  // namespace

TEST_CASE("a message of state:o has a stamp and encoders") {
  const StateMessage message = parse(kStamp + encoders({1.5, -20, 0}));
  CHECK(message.stamp.count == 12);
  CHECK(message.stamp.time_s == 1795247365.76);
  CHECK(message.encoders_deg == std::vector<double>{1.5, -20, 0});
  CHECK(parse(envelope("D 12 1795247365.76\r\n\0"s) + encoders({1})).stamp.count == 12);
  CHECK(parse(envelope("D 12 1795247365.76"s) + encoders({1})).stamp.count == 12);
  CHECK(parse(envelope("d 0 0\0"s) + encoders({1})).stamp.time_s == 0);
}

TEST_CASE("a real board's double is its 64 bits, least significant byte first") {
  CHECK(parse(kStamp + "\x0A\1\0\0\1\0\0\0\0\0\0\0\0\0\xF8\x3F"s).encoders_deg ==
        std::vector<double>{1.5});
}

TEST_CASE("any other message of state:o is refused") {
  const std::string good = kStamp + encoders({1, 2});
  REQUIRE_NOTHROW(parse(good));
  for (std::size_t size = 0; size < good.size(); ++size) {
    CAPTURE(size);
    CHECK_THROWS_AS(parse(good.substr(0, size)), YarpError);
  }
  CHECK_THROWS_AS(parse(good + "x"), YarpError);
  CHECK_THROWS_AS(parse(kStamp + encoders({})), YarpError);
  for (const std::string& text :
       {"D 12\0"s, "D\0"s, "D x 1\0"s, "D 12 1 2\0"s, "D 12 nan\0"s, "D 12 inf\0"s, "E 1 2\0"s,
        "D 1\0 2\0"s, "\0"s, "D 99999999999999999999 1\0"s, std::string(300, '1') + "\0"s}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse(envelope(text) + encoders({1})), YarpError);
  }
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_WITH(parse(kStamp + encoders({1, wrong})),
                      "the encoder of joint 1 is not a finite number");
  }
  // A list with a count of -1, of 2^31 - 1, and of 65 with as many encoders.
  CHECK_THROWS_AS(parse(kStamp + "\x0A\1\0\0\xFF\xFF\xFF\xFF"s), YarpError);
  CHECK_THROWS_AS(parse(kStamp + "\x0A\1\0\0\xFF\xFF\xFF\x7F"s), YarpError);
  CHECK_THROWS_AS(parse(kStamp + "\x0A\1\0\0\x41\0\0\0"s + std::string(65 * 8, '\0')), YarpError);
}

TEST_CASE("a board that disconnects, or sends no stamp, is recognised") {
  CHECK_THROWS_WITH(parse("\2\0\0\0~\0\0\1q\0"s), "it closes the connection");
  CHECK_THROWS_WITH(parse("\0\0\0\0~q\0\1"s), "it closes the connection");
  CHECK_THROWS_WITH(parse("\0\0\0\0~D\0\1"s + encoders({1})), "it sends encoders without a stamp");
}

}  // namespace puck
