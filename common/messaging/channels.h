#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "puck/arm_command_t.hpp"
#include "puck/arm_state_t.hpp"
#include "puck/event_packet_t.hpp"
#include "puck/game_state_t.hpp"
#include "puck/ground_truth_t.hpp"
#include "puck/head_state_t.hpp"
#include "puck/puck_estimate_t.hpp"
#include "puck/puck_trajectory_t.hpp"
#include "puck/service_status_t.hpp"

namespace puck {

/// One channel for each message type.
enum class Channel {
  kEvents,
  kEstimate,
  kTrajectory,
  kArmCommand,
  kArmState,
  kGame,
  kHead,
  kTruth,
  kStatus,
};

inline constexpr std::array kAllChannels{
    Channel::kEvents,     Channel::kEstimate, Channel::kTrajectory,
    Channel::kArmCommand, Channel::kArmState, Channel::kGame,
    Channel::kHead,       Channel::kTruth,    Channel::kStatus};

/// The channel that carries a message type: `kChannelOf<event_packet_t>`.
template <typename Message>
inline constexpr Channel kChannelOf = Message::no_channel_carries_this_type;
template <>
inline constexpr Channel kChannelOf<event_packet_t> = Channel::kEvents;
template <>
inline constexpr Channel kChannelOf<puck_estimate_t> = Channel::kEstimate;
template <>
inline constexpr Channel kChannelOf<puck_trajectory_t> = Channel::kTrajectory;
template <>
inline constexpr Channel kChannelOf<arm_command_t> = Channel::kArmCommand;
template <>
inline constexpr Channel kChannelOf<arm_state_t> = Channel::kArmState;
template <>
inline constexpr Channel kChannelOf<game_state_t> = Channel::kGame;
template <>
inline constexpr Channel kChannelOf<head_state_t> = Channel::kHead;
template <>
inline constexpr Channel kChannelOf<ground_truth_t> = Channel::kTruth;
template <>
inline constexpr Channel kChannelOf<service_status_t> = Channel::kStatus;

/// `PUCK_EVENTS`, …
std::string_view base_name(Channel channel);

/// `LEFT_PUCK_EVENTS` with prefix LEFT; `PUCK_EVENTS` with none.
std::string channel_name(Channel channel, std::string_view prefix);

/// `LEFT_PUCK_` with prefix LEFT: common beginning of all channel names.
std::string channel_beginning(std::string_view prefix);

/// The channel of this name under the prefix; nothing for a foreign name.
std::optional<Channel> find_channel(std::string_view name, std::string_view prefix);

/// The channel of this name under any prefix; nothing for a foreign name.
std::optional<Channel> find_channel_of_any_prefix(std::string_view name);

/// Throws BusError unless the prefix is up to 16 of A-Z, 0-9 and _.
void check_prefix(std::string_view prefix);

}  // namespace puck
