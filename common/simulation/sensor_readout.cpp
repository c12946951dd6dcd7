#include "common/simulation/sensor_readout.h"

#include <algorithm>

namespace puck {

SensorReadout::SensorReadout(double rate_mev_s, SensorSize size)
    : rate_per_us_(rate_mev_s),
      width_(static_cast<std::uint32_t>(size.width)),
      rows_(static_cast<std::size_t>(size.height)),
      is_waiting_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height)) {}

void SensorReadout::read(std::span<const PixelEvent> events, Timestamp from, Timestamp to,
                         EventPacket& packet) {
  if (packet.events.empty()) packet.start = from;
  sort(events, from, to);
  const auto slots = static_cast<std::size_t>(to - from);
  packet.events.reserve(packet.events.size() + events.size());
  if (!is_congested(slots)) {
    for (const PixelEvent& event : sorted_) put(event, event.t_us, packet);
    return;
  }
  const double most_credit = std::max(1.0, rate_per_us_);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    for (std::uint32_t i = first_at_[slot]; i < first_at_[slot + 1]; ++i) queue(sorted_[i]);
    credit_ = std::min(most_credit, credit_ + rate_per_us_);
    while (credit_ >= 1 && !row_order_.empty()) {
      Row& row = rows_[row_order_.front()];
      row_order_.pop_front();
      for (const PixelEvent& event : row) {
        put(event, from.us + static_cast<std::int64_t>(slot), packet);
        is_waiting_[event.pixel] = false;
      }
      credit_ -= static_cast<double>(row.size());
      row.clear();
    }
  }
}

// A counting sort: times are whole µs, so there are few distinct ones.
void SensorReadout::sort(std::span<const PixelEvent> events, Timestamp from, Timestamp to) {
  const auto slot_of = [&](const PixelEvent& event) {
    return static_cast<std::size_t>(event.t_us - from.us);
  };
  first_at_.assign(static_cast<std::size_t>(to - from) + 1, 0);
  for (const PixelEvent& event : events) ++first_at_[slot_of(event) + 1];
  for (std::size_t i = 1; i < first_at_.size(); ++i) first_at_[i] += first_at_[i - 1];
  sorted_.resize(events.size());
  for (const PixelEvent& event : events) sorted_[first_at_[slot_of(event)]++] = event;
  // Filling has moved each µs's begin to its end, which is the next µs's begin.
  std::copy_backward(first_at_.begin(), first_at_.end() - 1, first_at_.end());
  first_at_.front() = 0;
}

bool SensorReadout::is_congested(std::size_t slots) const {
  if (!row_order_.empty() || credit_ < 0) return true;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (first_at_[slot + 1] - first_at_[slot] > rate_per_us_) return true;
  }
  return false;
}

void SensorReadout::queue(const PixelEvent& event) {
  if (is_waiting_[event.pixel]) {
    ++lost_;
    return;
  }
  is_waiting_[event.pixel] = true;
  const std::uint32_t y = event.pixel / width_;
  if (rows_[y].empty()) row_order_.push_back(y);
  rows_[y].push_back(event);
}

void SensorReadout::put(const PixelEvent& event, std::int64_t t_us, EventPacket& packet) const {
  Event written;
  written.x = static_cast<std::uint16_t>(event.pixel % width_);
  written.y = static_cast<std::uint16_t>(event.pixel / width_) & 0x7fffu;
  written.polarity = event.polarity ? 1 : 0;
  written.offset_us = static_cast<std::uint32_t>(t_us - packet.start.us);
  packet.events.push_back(written);
}

}  // namespace puck
