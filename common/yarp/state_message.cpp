#include "common/yarp/state_message.h"

#include <cmath>

#include "common/yarp/little_endian.h"
#include "common/yarp/port_message.h"
#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

// A list (256) of 64-bit floating-point numbers (10).
constexpr std::int32_t kRealList = 266;

}  // namespace

StateMessage parse_state_message(std::span<const std::uint8_t> bytes) {
  const PortMessage whole = parse_port_message(bytes);
  if (!whole.stamp) throw YarpError("it sends encoders without a stamp");
  StateMessage message;
  message.stamp = *whole.stamp;
  LittleEndianReader reader(whole.content);
  if (reader.left() < 8 || reader.whole() != kRealList) {
    throw YarpError("it sent no list of encoders");
  }
  const std::int32_t count = reader.whole();
  if (count < 1 || count > static_cast<std::int32_t>(kMostBoardJoints) ||
      reader.left() != 8 * static_cast<std::size_t>(count)) {
    throw YarpError("it sent a list of encoders of an impossible size");
  }
  for (std::int32_t i = 0; i < count; ++i) {
    message.encoders_deg.push_back(reader.real());
    if (!std::isfinite(message.encoders_deg.back())) {
      throw YarpError("the encoder of joint " + std::to_string(i) + " is not a finite number");
    }
  }
  return message;
}

}  // namespace puck
