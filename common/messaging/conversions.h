#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/messages/arm_command.h"
#include "common/messages/arm_state.h"
#include "common/messages/camera_control.h"
#include "common/messages/game_state.h"
#include "common/messages/ground_truth.h"
#include "common/messages/head_state.h"
#include "common/messages/published_estimate.h"
#include "common/messages/table_trajectory.h"
#include "common/messaging/message_codec.h"

namespace puck {

// The plain types of common/messages as LCM's types. With this header, Bus and decode() take the
// plain ones, too. An estimate without a position has no velocity, size and covariance on the wire.

puck_estimate_t to_message(const PublishedEstimate& estimate);
puck_trajectory_t to_message(const TableTrajectory& trajectory);
arm_command_t to_message(const ArmCommand& command);
arm_state_t to_message(const ArmState& state);
camera_control_t to_message(const CameraControl& control);
game_state_t to_message(const GameState& game);
head_state_t to_message(const HeadState& head);
ground_truth_t to_message(const GroundTruth& truth);

/// For messages that passed check_message().
PublishedEstimate from_message(const puck_estimate_t& message);
ArmCommand from_message(const arm_command_t& message);
ArmState from_message(const arm_state_t& message);
CameraControl from_message(const camera_control_t& message);
GameState from_message(const game_state_t& message);
HeadState from_message(const head_state_t& message);
GroundTruth from_message(const ground_truth_t& message);

template <typename Plain>
using WireType = decltype(to_message(std::declval<const Plain&>()));

/// A type of common/messages.
template <typename Plain>
concept PlainMessage = requires {
  WireType<Plain>::getHash();
};

template <PlainMessage Plain>
inline constexpr Channel kChannelOf<Plain> = kChannelOf<WireType<Plain>>;

template <PlainMessage Plain>
void encode(Plain& plain, std::vector<std::uint8_t>& buffer) {
  WireType<Plain> message = to_message(plain);
  encode(message, buffer);
}

template <PlainMessage Plain>
void decode_checked(std::span<const std::uint8_t> bytes, Plain& plain) {
  WireType<Plain> message;
  decode_checked(bytes, message);
  plain = from_message(message);
}

}  // namespace puck
