#include "common/yarp/binary_carrier.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/yarp/yarp_error.h"
#include "tests/yarp/wire_bytes.h"

namespace puck {
namespace {

using namespace std::string_literals;
using namespace std::string_view_literals;

const std::string kIndex = "YA\x0A\0\0\0RP"s;
const std::string kPadding(8, '\xFF');

// A message of the blocks "abc" and "de".
const std::string kAbcDe = kIndex + "\2\1"s + kPadding + "\3\0\0\0\2\0\0\0\0\0\0\0abcde"s;

std::string joined(std::span<const std::uint8_t> bytes) { return {bytes.begin(), bytes.end()}; }

// A reader's messages from bytes in pieces of `piece`.
std::vector<std::string> read_in_pieces(const std::string& text, std::size_t piece) {
  MessageReader reader;
  std::vector<std::string> messages;
  const Bytes bytes = wire(text);
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    reader.feed(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at)));
    while (const auto message = reader.next()) messages.push_back(joined(*message));
  }
  return messages;
}

}  // namespace

TEST_CASE("a connection begins with the greeting that a real port accepts") {
  CHECK(as_text(hello("puck")) == "YA\x64\x1E\0\0RP\5\0\0\0puck\0"s);
}

TEST_CASE("any tagged number is an answer to a greeting, and nothing else") {
  const auto answer = [](std::string_view text) {
    const Bytes bytes = wire(text);
    check_hello_answer(std::span(bytes).first<kHelloAnswerBytes>());
  };
  CHECK_NOTHROW(answer("YA\x1A\x27\0\0RP"sv));
  for (const auto wrong :
       {"HTTP/1.1"sv, "YA\x1A\x27\0\0RQ"sv, "YA\x1A\x27\1\0RP"sv, "\0\0\0\0\0\0\0\0"sv}) {
    CHECK_THROWS_AS(answer(wrong), YarpError);
  }
}

TEST_CASE("a message is an index, the sizes of its blocks, and the blocks") {
  Bytes bytes;
  append_message(PortCommand::kTurnRound, {}, bytes);
  CHECK(as_text(bytes) == kIndex + "\1\1"s + kPadding + "\x8\0\0\0\0\0\0\0\0\0\0\0~r\0\1"s);

  bytes.clear();
  append_message(PortCommand::kData, wire("payload"), bytes);
  CHECK(as_text(bytes) ==
        kIndex + "\2\1"s + kPadding + "\x8\0\0\0\7\0\0\0\0\0\0\0\0\0\0\0~d\0\1payload"s);
}

TEST_CASE("messages are extracted from bytes in any division") {
  const std::string three = kAbcDe + kAbcDe + kAbcDe;
  for (const std::size_t piece : {1, 2, 7, 35, 36, 1000}) {
    CAPTURE(piece);
    CHECK(read_in_pieces(three, piece) == std::vector<std::string>(3, "abcde"));
  }
  CHECK(read_in_pieces(kAbcDe.substr(0, kAbcDe.size() - 1), 3).empty());
}

TEST_CASE("an invalid message is refused at its first wrong byte, and sizes are not trusted") {
  const auto is_refused = [](const std::string& text) {
    MessageReader reader;
    reader.feed(wire(text));
    try {
      while (reader.next()) {
      }
      return false;
    } catch (const YarpError&) {
      return true;
    }
  };
  CHECK(!is_refused(kAbcDe + "YA\x0A"));
  CHECK(is_refused("H"));
  CHECK(is_refused("YA\x0B"));
  CHECK(is_refused(kAbcDe + "x"));
  CHECK(is_refused(kIndex + "\0\1"s + kPadding));
  CHECK(is_refused(kIndex + "\x7F\1"s + kPadding));
  CHECK(is_refused(kIndex + "\xFF\1"s + kPadding));
  CHECK(is_refused(kIndex + "\1\0"s + kPadding));
  CHECK(is_refused(kIndex + "\1\1"s + std::string(8, '\xFE')));
  // Sizes of 2 GB, of -1, of 4097, two with too large a sum, and an answer's.
  const std::string one = kIndex + "\1\1"s + kPadding;
  CHECK(is_refused(one + "\xFF\xFF\xFF\x7F\0\0\0\0"s));
  CHECK(is_refused(one + "\xFF\xFF\xFF\xFF\0\0\0\0"s));
  CHECK(is_refused(one + "\1\x10\0\0\0\0\0\0"s));
  CHECK(!is_refused(one + "\0\x10\0\0\0\0\0\0"s));
  CHECK(is_refused(kIndex + "\2\1"s + kPadding + "\0\x10\0\0\1\0\0\0\0\0\0\0"s));
  CHECK(is_refused(one + "\1\0\0\0\1\0\0\0"s));
}

}  // namespace puck
