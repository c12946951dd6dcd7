#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/message_check.h"

namespace puck {

/// Sets the counts on the wire from the sizes of the arrays: LCM's encoder trusts them and would
/// read beyond an array's end. Arrays that share a count are cut to the shortest.
template <typename Message>
void set_counts(Message&) {}
void set_counts(event_packet_t& message);
void set_counts(puck_trajectory_t& message);
void set_counts(arm_state_t& message);
void set_counts(service_status_t& message);

/// Encodes into `buffer`, whose memory is used again.
template <typename Message>
void encode(Message& message, std::vector<std::uint8_t>& buffer) {
  set_counts(message);
  buffer.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(buffer.data(), 0, static_cast<int>(buffer.size()));
}

/// Only for bytes that check_message() let pass, and a new message object.
template <typename Message>
void decode_checked(std::span<const std::uint8_t> bytes, Message& message) {
  message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
}

/// Decodes bytes from anywhere: nothing, or why they are not a valid message.
template <typename Message>
std::optional<std::string> decode(std::span<const std::uint8_t> bytes, Message& message) {
  auto rejection = check_message(kChannelOf<Message>, bytes);
  if (rejection) return rejection;
  message = Message{};
  decode_checked(bytes, message);
  return std::nullopt;
}

}  // namespace puck
