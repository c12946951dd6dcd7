#include "common/yarp/port_message.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "common/yarp/little_endian.h"
#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

constexpr std::size_t kCommandBytes = 8;
constexpr std::size_t kLongestEnvelope = 256;

template <typename Number>
bool take_number(std::string_view& text, Number& number) {
  if (text.empty() || text.front() != ' ') return false;
  text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

PortStamp parse_envelope(std::string_view text) {
  if (text == "q") throw YarpError("it closes the connection");
  PortStamp stamp;
  const bool is_data = text.starts_with('D') || text.starts_with('d');
  std::string_view rest = is_data ? text.substr(1) : text;
  if (!is_data || !take_number(rest, stamp.count) || !take_number(rest, stamp.time_s) ||
      !rest.empty() || !std::isfinite(stamp.time_s)) {
    throw YarpError("it sent the envelope " + in_quotes(text));
  }
  return stamp;
}

}  // namespace

PortMessage parse_port_message(std::span<const std::uint8_t> bytes) {
  LittleEndianReader reader(bytes);
  if (reader.left() < kCommandBytes) throw YarpError("it sent a message without a port command");
  const std::int32_t length = reader.whole();
  const auto command = reader.take(4);
  if (command[0] != '~' || command[2] != 0 || command[3] != 1) {
    throw YarpError("it sent a message that begins with no port command");
  }
  if (command[1] == 'q') throw YarpError("it closes the connection");
  if (command[1] != 0) return {std::nullopt, bytes.subspan(reader.at())};
  if (length < 2 || static_cast<std::size_t>(length) > kLongestEnvelope ||
      static_cast<std::size_t>(length) > reader.left()) {
    throw YarpError("it sent an envelope of an impossible size");
  }
  const auto envelope = reader.take(static_cast<std::size_t>(length));
  // Without its NUL and line end.
  const std::string_view text(reinterpret_cast<const char*>(envelope.data()), envelope.size());
  const std::size_t end = text.find_last_not_of(std::string_view(" \r\n\0", 4)) + 1;
  return {parse_envelope(text.substr(0, end)), bytes.subspan(reader.at())};
}

}  // namespace puck
