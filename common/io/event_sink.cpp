#include "common/io/event_sink.h"

#include "common/io/event_checks.h"

namespace puck {

EventSink::EventSink(SensorSize sensor, std::int64_t reorder_us)
    : sensor_(checked_sensor(sensor)), reorder_us_(reorder_us) {}

void EventSink::begin(EventPacket& packet, std::size_t max_events) {
  packet_ = &packet;
  max_events_ = max_events;
  while (has_backlog() && packet.events.size() < max_events && hand_out(backlog_[backlog_taken_])) {
    ++backlog_taken_;
  }
  // Only when all are gone: moving the rest up for each packet would take quadratic time.
  if (!has_backlog()) {
    backlog_.clear();
    backlog_taken_ = 0;
  }
}

}  // namespace puck
