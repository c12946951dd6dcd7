#include "services/camera/event_batcher.h"

#include <algorithm>
#include <span>
#include <stdexcept>

namespace puck {

EventBatcher::EventBatcher(std::size_t max_events, std::int64_t max_age_us,
                           std::int64_t quiet_age_us)
    : max_events_(max_events) {
  if (max_events < 1) throw std::invalid_argument("a batch must hold at least 1 event");
  set_ages(max_age_us, quiet_age_us);
  batch_.events.reserve(max_events);
}

void EventBatcher::set_ages(std::int64_t max_age_us, std::int64_t quiet_age_us) {
  if (max_age_us < 1) throw std::invalid_argument("a batch must last at least 1 µs");
  max_age_us_ = max_age_us;
  quiet_age_us_ = std::max(quiet_age_us, max_age_us);
}

void EventBatcher::take(const EventPacket& packet, std::size_t& next) {
  // First up to kFew events, since more of them shorten the window.
  if (has_few()) take_until(packet, next, std::min(kFew, max_events_));
  if (!has_few()) take_until(packet, next, max_events_);
}

// Takes events within the present window, until the batch has `most` events.
void EventBatcher::take_until(const EventPacket& packet, std::size_t& next, std::size_t most) {
  const auto left = std::span(packet.events).subspan(next);
  if (left.empty() || batch_.events.size() >= most) return;
  if (batch_.empty()) batch_.start = packet.time_of(left.front());
  const auto end = std::partition_point(left.begin(), left.end(), [&](const Event& event) {
    return packet.time_of(event) < window_end();
  });
  const auto count =
      std::min(static_cast<std::size_t>(end - left.begin()), most - batch_.events.size());
  const std::size_t before = batch_.events.size();
  batch_.events.insert(batch_.events.end(), left.begin(),
                       left.begin() + static_cast<std::ptrdiff_t>(count));
  // Modulo 2^32, since the packet may begin before the batch.
  const auto shift_us = static_cast<std::uint32_t>(packet.start - batch_.start);
  for (Event& event : std::span(batch_.events).subspan(before)) event.offset_us += shift_us;
  next += count;
}

bool EventBatcher::is_complete(Timestamp until) const {
  return !batch_.empty() && (is_full() || until >= window_end());
}

// With few events, the newest may be later than the end of the shorter window.
Timestamp EventBatcher::due() const {
  return is_full() ? batch_.newest() : std::max(window_end(), batch_.newest());
}

}  // namespace puck
