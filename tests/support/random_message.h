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

/// Calls `use(Message{})` with the type that the channel carries.
template <typename Use>
void with_message_type(Channel channel, Use&& use) {
  switch (channel) {
    case Channel::kEvents:
      return use(event_packet_t{});
    case Channel::kEstimate:
      return use(puck_estimate_t{});
    case Channel::kTrajectory:
      return use(puck_trajectory_t{});
    case Channel::kArmCommand:
      return use(arm_command_t{});
    case Channel::kArmState:
      return use(arm_state_t{});
    case Channel::kGame:
      return use(game_state_t{});
    case Channel::kHead:
      return use(head_state_t{});
    case Channel::kTruth:
      return use(ground_truth_t{});
    case Channel::kStatus:
      return use(service_status_t{});
  }
}

}  // namespace puck
