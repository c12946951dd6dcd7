#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "common/messaging/channels.h"

namespace puck {

/// Header of every message.
struct MessageHeader {
  std::int64_t utime = 0;    ///< Host CLOCK_REALTIME at publish, µs.
  std::int64_t session = 0;  ///< Random id of the publisher's run.
  std::int64_t seq = 0;      ///< Messages published before this one in this session.
};

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
