#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "common/messaging/channels.h"

namespace puck {

/// What every message begins with.
struct MessageHeader {
  std::int64_t utime = 0;    ///< Host CLOCK_REALTIME at publish, µs.
  std::int64_t session = 0;  ///< Random id of the publisher's run.
  std::int64_t seq = 0;      ///< Messages published before this one in this session.
};

/// The only gate to LCM's generated decoders, which crash or lie on bad bytes. Walks the bytes
/// along the layout of the channel's type: fingerprint, counts, lengths, ranges, finite numbers,
/// nothing missing and nothing left over; then what the fields mean together. Nothing when all is
/// well, else the reason. Reads nothing outside `bytes`.
std::optional<std::string> check_message(Channel channel, std::span<const std::uint8_t> bytes);

/// Only for bytes that check_message() let pass.
MessageHeader read_header(std::span<const std::uint8_t> bytes);

/// The numbering of the events in a packet.
struct EventNumbering {
  std::int64_t events_before = 0;
  std::int64_t events = 0;
};
/// Only for bytes that check_message() let pass as EVENTS.
EventNumbering read_event_numbering(std::span<const std::uint8_t> bytes);

}  // namespace puck
