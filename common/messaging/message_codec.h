#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/message_check.h"

namespace puck {

/// Sets the count fields from the array sizes: LCM's encoder trusts the counts and would read
/// beyond an array's end. Arrays with a common count are cut to the shortest.
template <typename Message>
void set_counts(Message& message) {
  with_arrays(message, [](std::int32_t& count, auto&... arrays) {
    const std::size_t shortest = std::min(
        {static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()), arrays.size()...});
    (arrays.resize(shortest), ...);
    count = static_cast<std::int32_t>(shortest);
  });
}

/// Encodes into `buffer`, reusing its memory.
template <typename Message>
void encode(Message& message, std::vector<std::uint8_t>& buffer) {
  set_counts(message);
  buffer.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(buffer.data(), 0, static_cast<int>(buffer.size()));
}

/// Requires bytes that passed check_message(), and a new message object.
template <typename Message>
void decode_checked(std::span<const std::uint8_t> bytes, Message& message) {
  message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
}

/// Decodes bytes of any origin; returns the reason if they are no valid message.
template <typename Message>
std::optional<std::string> decode(std::span<const std::uint8_t> bytes, Message& message) {
  auto rejection = check_message(kChannelOf<Message>, bytes);
  if (rejection) return rejection;
  message = Message{};
  decode_checked(bytes, message);
  return std::nullopt;
}

}  // namespace puck
