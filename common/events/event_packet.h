#pragma once

#include <vector>

#include "common/events/event.h"
#include "common/events/timestamp.h"

namespace puck {

/// Events in the order of their times; `events[i]` happened at `start + events[i].offset_us`.
struct EventPacket {
  Timestamp start;
  std::vector<Event> events;

  bool empty() const { return events.empty(); }
  Timestamp time_of(const Event& event) const { return start + event.offset_us; }
  /// Sensor time of the newest event. The packet must not be empty.
  Timestamp newest() const { return time_of(events.back()); }
};

}  // namespace puck
