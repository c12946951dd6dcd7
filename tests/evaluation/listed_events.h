#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/event_reader.h"

namespace puck {

/// One event at each of some times, on a sensor of 64x48.
class ListedEvents final : public EventReader {
 public:
  explicit ListedEvents(std::vector<std::int64_t> times_us) : times_us_(std::move(times_us)) {}

  SensorSize sensor_size() const override { return {64, 48}; }

  bool read(EventPacket& packet, std::size_t max_events) override {
    packet.events.clear();
    if (next_ == times_us_.size()) return false;
    packet.start = {times_us_[next_]};
    const std::size_t end = std::min(times_us_.size(), next_ + max_events);
    for (; next_ < end; ++next_) {
      Event event{};
      event.offset_us = static_cast<std::uint32_t>(times_us_[next_] - packet.start.us);
      packet.events.push_back(event);
    }
    return true;
  }
  bool can_rewind() const override { return true; }
  void rewind() override {
    next_ = 0;
    ++rewinds_;
  }
  int rewinds() const { return rewinds_; }
  const EventCounters& counters() const override { return counters_; }
  std::vector<std::string> warnings() const override { return {}; }

 private:
  std::vector<std::int64_t> times_us_;
  std::size_t next_ = 0;
  int rewinds_ = 0;
  EventCounters counters_;
};

/// Of all events, which come in packets of `most` at most.
inline std::vector<std::int64_t> times_of(EventReader& events, std::size_t most = 100'000) {
  std::vector<std::int64_t> times;
  EventPacket packet;
  while (events.read(packet, most)) {
    CHECK_FALSE(packet.empty());
    REQUIRE(packet.events.size() <= most);
    for (const Event& event : packet.events) times.push_back(packet.time_of(event).us);
  }
  return times;
}

}  // namespace puck
