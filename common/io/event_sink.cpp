#include "common/io/event_sink.h"

#include "common/io/event_checks.h"

namespace puck {

EventSink::EventSink(SensorSize sensor) : sensor_(checked_sensor(sensor)) {}

void EventSink::begin(EventPacket& packet, std::size_t max_events) {
  packet_ = &packet;
  max_events_ = max_events;
  std::size_t taken = 0;
  while (taken < backlog_.size() && packet.events.size() < max_events &&
         hand_out(backlog_[taken])) {
    ++taken;
  }
  backlog_.erase(backlog_.begin(), backlog_.begin() + static_cast<std::ptrdiff_t>(taken));
}

}  // namespace puck
