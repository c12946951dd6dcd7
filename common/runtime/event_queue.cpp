#include "common/runtime/event_queue.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>

namespace puck {

EventQueue::EventQueue(std::size_t capacity) {
  if (capacity < 2) {
    throw std::invalid_argument("an event queue needs room for at least 2 events, got " +
                                std::to_string(capacity));
  }
  slots_.resize(std::bit_ceil(capacity));
}

void EventQueue::push(Timestamp start, std::span<const Event> events) {
  const std::uint64_t begin = begin_.load(std::memory_order_acquire);
  std::uint64_t end = end_.load(std::memory_order_relaxed);
  const auto space = [&] { return slots_.size() - static_cast<std::size_t>(end - begin); };
  std::size_t accepted = 0;
  std::size_t stride = stride_for(space());
  for (const Event& event : events) {
    if (++skipped_ < stride) continue;
    skipped_ = 0;
    slot(end) = {(start + event.offset_us).us, event};
    ++end;
    ++accepted;
    stride = stride_for(space());
  }
  if (accepted > 0) end_.store(end, std::memory_order_release);
  if (accepted < events.size()) {
    thinned_.store(thinned_.load(std::memory_order_relaxed) +
                       static_cast<std::int64_t>(events.size() - accepted),
                   std::memory_order_relaxed);
  }
}

// The largest power of two that is at most capacity / space.
std::size_t EventQueue::stride_for(std::size_t space) const {
  if (space == 0) return std::numeric_limits<std::size_t>::max();
  return slots_.size() >> std::bit_width(space - 1);
}

Timestamp EventQueue::pop(std::uint64_t until, std::size_t most, std::vector<Event>& out) {
  const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
  const std::uint64_t end = std::min(until, end_.load(std::memory_order_acquire));
  out.clear();
  if (begin >= end) return {};
  const Timestamp start{slot(begin).time_us};
  const std::uint64_t last = begin + std::min<std::uint64_t>(end - begin, most);
  std::uint64_t position = begin;
  for (; position < last; ++position) {
    const Slot& next = slot(position);
    const std::int64_t offset_us = next.time_us - start.us;
    if (offset_us > std::numeric_limits<std::uint32_t>::max()) break;
    out.push_back(next.event);
    out.back().offset_us = static_cast<std::uint32_t>(offset_us);
  }
  begin_.store(position, std::memory_order_release);
  return start;
}

}  // namespace puck
