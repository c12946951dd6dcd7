#include "tools/view/recording/rate_scan.h"

#include <algorithm>
#include <exception>
#include <stop_token>
#include <utility>

namespace puck {
namespace {

constexpr std::int64_t kFirstBin_us = 1000;

}  // namespace

RateScan::RateScan(std::unique_ptr<EventReader> events)
    : events_(std::move(events)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

void RateScan::run(const std::stop_token& stop) {
  EventPacket packet;
  std::vector<std::string> warnings;
  try {
    while (!stop.stop_requested() && events_->read(packet, EventReader::kUsualEvents)) {
      count(packet);
    }
    warnings = events_->warnings();
  } catch (const std::exception& error) {
    warnings.emplace_back(error.what());
  }
  const std::lock_guard lock(mutex_);
  found_.is_complete = true;
  warnings_ = std::move(warnings);
}

void RateScan::count(const EventPacket& packet) {
  const std::lock_guard lock(mutex_);
  if (found_.bin_us == 0) {
    found_.bin_us = kFirstBin_us;
    found_.first = packet.time_of(packet.events.front());
  }
  found_.last = packet.newest();
  while ((found_.last - found_.first) / found_.bin_us >= static_cast<std::int64_t>(kMostBins)) {
    found_.bin_us *= 2;
    for (std::size_t i = 0; i < found_.events.size(); ++i) {
      const std::int64_t events = std::exchange(found_.events[i], 0);
      found_.events[i / 2] += events;
    }
    found_.events.resize((found_.events.size() + 1) / 2);
  }
  found_.events.resize(static_cast<std::size_t>((found_.last - found_.first) / found_.bin_us) + 1);
  for (const Event& event : packet.events) {
    const std::int64_t bin = (packet.time_of(event) - found_.first) / found_.bin_us;
    ++found_.events[static_cast<std::size_t>(std::max<std::int64_t>(bin, 0))];
  }
}

void RateScan::fill(ViewTimeline& timeline) const {
  const std::lock_guard lock(mutex_);
  timeline.first = found_.first;
  timeline.last = found_.last;
  timeline.is_complete = found_.is_complete;
  timeline.bin_us = found_.bin_us;
  timeline.events = found_.events;
}

std::vector<std::string> RateScan::warnings() const {
  const std::lock_guard lock(mutex_);
  return warnings_;
}

}  // namespace puck
