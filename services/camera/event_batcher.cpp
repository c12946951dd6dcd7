#include "services/camera/event_batcher.h"

#include <stdexcept>

namespace puck {

EventBatcher::EventBatcher(std::size_t max_events, std::int64_t max_age_us)
    : max_events_(max_events), max_age_us_(max_age_us) {
  if (max_events < 1 || max_age_us < 1) {
    throw std::invalid_argument("a batch must hold at least 1 event and last at least 1 µs");
  }
  batch_.events.reserve(max_events);
}

void EventBatcher::take(const EventPacket& packet, std::size_t& next) {
  for (; next < packet.events.size() && !is_full(); ++next) {
    Event event = packet.events[next];
    const Timestamp time = packet.time_of(event);
    if (batch_.empty()) batch_.start = time;
    if (time >= window_end()) return;
    event.offset_us = static_cast<std::uint32_t>(time - batch_.start);
    batch_.events.push_back(event);
  }
}

bool EventBatcher::is_complete(Timestamp until) const {
  return !batch_.empty() && (is_full() || until >= window_end());
}

Timestamp EventBatcher::due() const { return is_full() ? batch_.newest() : window_end(); }

}  // namespace puck
