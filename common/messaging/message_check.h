#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "common/messages/message_header.h"
#include "common/messaging/channels.h"

namespace puck {

/// Required before LCM's generated decoders, which crash or return garbage on malformed bytes.
/// Checks the bytes against the layout of the channel's type: fingerprint, counts, lengths, ranges,
/// finite numbers, exact size; then the relations between fields. Returns nothing if valid, else
/// the reason. Reads nothing outside `bytes`.
std::optional<std::string> check_message(Channel channel, std::span<const std::uint8_t> bytes);

/// Requires bytes that passed check_message().
MessageHeader read_header(std::span<const std::uint8_t> bytes);

/// The numbering of the events in a packet.
struct EventNumbering {
  std::int64_t events_before = 0;
  std::int64_t events = 0;
};
/// Requires bytes that passed check_message() for EVENTS.
EventNumbering read_event_numbering(std::span<const std::uint8_t> bytes);

}  // namespace puck
