#include "common/yarp/state_message.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "common/yarp/board_error.h"
#include "common/yarp/little_endian.h"

namespace puck {
namespace {

constexpr std::size_t kCommandBytes = 8;
constexpr std::size_t kLongestEnvelope = 256;
// A list (256) of 64-bit floating-point numbers (10).
constexpr std::int32_t kRealList = 266;

// The envelope's text, without its NUL and line end.
std::string_view take_envelope(LittleEndianReader& reader) {
  if (reader.left() < kCommandBytes) throw BoardError("it sent a message without a port command");
  const std::int32_t length = reader.whole();
  const auto command = reader.take(4);
  if (command[0] != '~' || command[2] != 0 || command[3] != 1) {
    throw BoardError("it sent a message that begins with no port command");
  }
  if (command[1] == 'q') throw BoardError("it closes the connection");
  if (command[1] != 0) throw BoardError("it sends encoders without a stamp");
  if (length < 2 || static_cast<std::size_t>(length) > kLongestEnvelope ||
      static_cast<std::size_t>(length) > reader.left()) {
    throw BoardError("it sent an envelope of an impossible size");
  }
  const auto bytes = reader.take(static_cast<std::size_t>(length));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.substr(0, text.find_last_not_of(std::string_view(" \r\n\0", 4)) + 1);
}

template <typename Number>
bool take_number(std::string_view& text, Number& number) {
  if (text.empty() || text.front() != ' ') return false;
  text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

BoardStamp parse_envelope(std::string_view text) {
  if (text == "q") throw BoardError("it closes the connection");
  BoardStamp stamp;
  const bool is_data = text.starts_with('D') || text.starts_with('d');
  std::string_view rest = is_data ? text.substr(1) : text;
  if (!is_data || !take_number(rest, stamp.count) || !take_number(rest, stamp.time_s) ||
      !rest.empty() || !std::isfinite(stamp.time_s)) {
    throw BoardError("it sent the envelope " + in_quotes(text));
  }
  return stamp;
}

}  // namespace

StateMessage parse_state_message(std::span<const std::uint8_t> bytes) {
  LittleEndianReader reader(bytes);
  StateMessage message;
  message.stamp = parse_envelope(take_envelope(reader));
  if (reader.left() < 8 || reader.whole() != kRealList) {
    throw BoardError("it sent no list of encoders");
  }
  const std::int32_t count = reader.whole();
  if (count < 1 || count > static_cast<std::int32_t>(kMostBoardJoints) ||
      reader.left() != 8 * static_cast<std::size_t>(count)) {
    throw BoardError("it sent a list of encoders of an impossible size");
  }
  for (std::int32_t i = 0; i < count; ++i) {
    message.encoders_deg.push_back(reader.real());
    if (!std::isfinite(message.encoders_deg.back())) {
      throw BoardError("the encoder of joint " + std::to_string(i) + " is not a finite number");
    }
  }
  return message;
}

}  // namespace puck
