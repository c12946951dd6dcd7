#pragma once

#include <cstdint>

namespace puck {

/// Packet and event counts of a session.
struct PacketCounters {
  std::int64_t received = 0;
  std::int64_t lost = 0;
  std::int64_t late = 0;  ///< Duplicates, and packets after a later one; dropped.
  std::int64_t rejected = 0;
  std::int64_t events_lost = 0;     ///< In lost packets.
  std::int64_t events_skipped = 0;  ///< In packets skipped to keep up with the newest.
  std::int64_t events_dropped = 0;  ///< By the source, before they were published.
};

}  // namespace puck
