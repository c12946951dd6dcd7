#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/message_codec.h"

namespace puck {

/// A message as bytes, and the offset of each count field in them.
struct RandomMessage {
  std::vector<std::uint8_t> bytes;
  std::vector<std::size_t> count_offsets;
};

/// Random content in the layout of the channel's type, every field within its limits. The fields of
/// EVENTS may contradict one another.
RandomMessage random_structure(Channel channel, std::mt19937_64& random);

/// The same, but valid: EVENTS hold random events of a 640 x 480 sensor.
RandomMessage random_message(Channel channel, std::mt19937_64& random);

}  // namespace puck
