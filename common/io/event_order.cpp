#include "common/io/event_order.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/io/event_reader.h"
#include "common/io/sorted_events.h"

namespace puck {
namespace {

// Of a merged packet.
constexpr std::size_t kMostMergedEvents = 4096;
constexpr std::size_t kMostSparePackets = 4;

}  // namespace

EventOrder::EventOrder(std::int64_t reorder_us) : reorder_us_(reorder_us) {
  if (reorder_us < 0 || reorder_us > EventFileOptions::kMostReorderUs) {
    throw std::invalid_argument("reorder_us must be from 0 to " +
                                std::to_string(EventFileOptions::kMostReorderUs) + ", got " +
                                std::to_string(reorder_us));
  }
}

void EventOrder::add(EventPacket& packet) {
  if (packet.empty()) return;
  if (is_in_order(packet)) {
    held_ += packet.events.size();
    newest_ = packet.newest();
    std::swap(push_empty(), packet);
  } else {
    drop_late(packet);
    held_ += packet.events.size();
    if (!packet.empty()) merge(packet);
  }
  packet.events.clear();
}

bool EventOrder::take(EventPacket& packet, std::size_t max_events) {
  packet.events.clear();
  if (queue_.empty()) return false;
  EventPacket& front = queue_.front();
  if (!is_finished_ && held_ <= kMostHeld && newest_ - front.newest() < reorder_us_) return false;
  if (front_taken_ == 0 && front.events.size() <= max_events) {
    std::swap(packet, front);
    take_note_of(packet);
  } else {
    const auto first = front.events.begin() + static_cast<std::ptrdiff_t>(front_taken_);
    const std::size_t count = std::min(max_events, front.events.size() - front_taken_);
    packet.start = front.time_of(*first);
    packet.events.assign(first, first + static_cast<std::ptrdiff_t>(count));
    const std::uint32_t start_us = packet.events.front().offset_us;
    for (Event& event : packet.events) event.offset_us -= start_us;
    take_note_of(packet);
    front_taken_ += count;
    if (front_taken_ < front.events.size()) return true;
    front_taken_ = 0;
  }
  if (spare_.size() < kMostSparePackets) spare_.push_back(std::move(front));
  queue_.pop_front();
  return true;
}

void EventOrder::take_note_of(const EventPacket& packet) {
  held_ -= packet.events.size();
  handed_out_ = packet.newest();
}

void EventOrder::drop_late(EventPacket& packet) {
  const auto late = std::erase_if(
      packet.events, [&](const Event& event) { return packet.time_of(event) < handed_out_; });
  dropped_ += static_cast<std::int64_t>(late);
}

bool EventOrder::is_in_order(const EventPacket& packet) const {
  const Timestamp first = packet.time_of(packet.events.front());
  if (first < handed_out_ || (!queue_.empty() && first < newest_)) return false;
  return are_sorted(packet.events);
}

// Sorts the packet's events into the packets that they overlap.
void EventOrder::merge(const EventPacket& packet) {
  Timestamp oldest = packet.start + packet.events.front().offset_us;
  for (const Event& event : packet.events) oldest = std::min(oldest, packet.time_of(event));
  auto first = queue_.end();
  while (first != queue_.begin() && std::prev(first)->newest() > oldest) --first;

  merged_.clear();
  for (auto each = first; each != queue_.end(); ++each) {
    const std::size_t from = each == queue_.begin() ? std::exchange(front_taken_, 0) : 0;
    for (std::size_t i = from; i < each->events.size(); ++i) {
      merged_.push_back({each->time_of(each->events[i]), each->events[i]});
    }
  }
  queue_.erase(first, queue_.end());
  const auto queued = static_cast<std::ptrdiff_t>(merged_.size());
  Timestamp newest = queue_.empty() && merged_.empty() ? oldest : newest_;
  for (const Event& event : packet.events) {
    const Timestamp time = packet.time_of(event);
    if (time < newest) ++reordered_;
    newest = std::max(newest, time);
    merged_.push_back({time, event});
  }
  newest_ = newest;
  const auto older = [](const TimedEvent& a, const TimedEvent& b) { return a.time < b.time; };
  std::stable_sort(merged_.begin() + queued, merged_.end(), older);
  std::inplace_merge(merged_.begin(), merged_.begin() + queued, merged_.end(), older);
  push_merged();
}

void EventOrder::push_merged() {
  EventPacket* out = nullptr;
  for (const TimedEvent& each : merged_) {
    if (out == nullptr || out->events.size() == kMostMergedEvents ||
        each.time - out->start > std::numeric_limits<std::uint32_t>::max()) {
      out = &push_empty();
      out->start = each.time;
    }
    out->events.push_back(each.event);
    out->events.back().offset_us = static_cast<std::uint32_t>(each.time - out->start);
  }
}

EventPacket& EventOrder::push_empty() {
  EventPacket packet;
  if (!spare_.empty()) {
    packet = std::move(spare_.back());
    spare_.pop_back();
    packet.events.clear();
  }
  return queue_.emplace_back(std::move(packet));
}

}  // namespace puck
