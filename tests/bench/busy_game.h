#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/events/event_packet.h"

namespace puck {

struct TimedPixel {
  std::int64_t time_us = 0;
  Event event;  ///< Its offset is not used.
};

std::vector<TimedPixel> timed(const EventPacket& packet);

/// Sorts by time.
void sort_by_time(std::vector<TimedPixel>& events);

/// A game at its own speed, as a sensor would see it that makes `rate_mev_s` events: each event is
/// repeated within about a ms, or only some are kept. In the order of their times; at most about
/// `most`.
std::vector<TimedPixel> busy_game(const EventPacket& game, double rate_mev_s, std::size_t most);

}  // namespace puck
