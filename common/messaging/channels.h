#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "puck/channels.hpp"

namespace puck {

// Generated from lcmtypes/: enum class Channel, one for each message type (Channel::kEvents, …);
// kAllChannels; kChannelOf<event_packet_t>, the channel that carries a type; with_message_type,
// which calls use(Message{}) with the type that a channel carries.

/// `PUCK_EVENTS`, …
constexpr std::string_view base_name(Channel channel) {
  return kBaseNames[static_cast<std::size_t>(channel)];
}

/// `LEFT_PUCK_EVENTS` with prefix LEFT; `PUCK_EVENTS` with none.
std::string channel_name(Channel channel, std::string_view prefix);

/// `LEFT_PUCK_` with prefix LEFT: common beginning of all channel names.
std::string channel_beginning(std::string_view prefix);

/// The channel of this name under the prefix; nothing for a foreign name.
std::optional<Channel> find_channel(std::string_view name, std::string_view prefix);

/// The channel of this name under any prefix; nothing for a foreign name.
std::optional<Channel> find_channel_of_any_prefix(std::string_view name);

/// Throws BusError unless the prefix is up to 16 of A-Z, 0-9 and _. `key`: what the user has set:
/// --prefix, camera.log_prefix, …
void check_prefix(std::string_view prefix, std::string_view key = "lcm.prefix");

}  // namespace puck
