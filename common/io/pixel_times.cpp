#include "common/io/pixel_times.h"

#include <algorithm>
#include <limits>

namespace puck {
namespace {

constexpr std::int64_t kNewestStamp = std::numeric_limits<std::uint32_t>::max();

}  // namespace

PixelTimes::PixelTimes(SensorSize sensor, std::int64_t longest_us)
    : row_length_(static_cast<std::size_t>(sensor.width) + 2),
      longest_us_(longest_us),
      stamps_(row_length_ * (static_cast<std::size_t>(sensor.height) + 2)) {}

void PixelTimes::clear() {
  std::fill(stamps_.begin(), stamps_.end(), 0);
  has_base_ = false;
}

std::size_t PixelTimes::prepare(const EventPacket& packet, std::size_t first) {
  const Timestamp oldest = packet.time_of(packet.events[first]);
  if (has_base_ && oldest <= base_ + longest_us_) clear();
  if (!has_base_) {
    has_base_ = true;
    base_ = oldest - (longest_us_ + 1);
  }
  if (packet.newest() - base_ > kNewestStamp) rebase(oldest);
  packet_start_ = static_cast<std::uint32_t>(packet.start - base_);
  const auto& events = packet.events;
  if (packet.newest() - base_ <= kNewestStamp) return events.size();
  const auto end = std::partition_point(
      events.begin() + static_cast<std::ptrdiff_t>(first), events.end(),
      [&](const Event& event) { return packet.time_of(event) - base_ <= kNewestStamp; });
  return static_cast<std::size_t>(end - events.begin());
}

// Keeps the age of every time that is at most longest_us_ old.
void PixelTimes::rebase(Timestamp oldest) {
  const Timestamp base = oldest - (longest_us_ + 1);
  const std::int64_t moved_us = base - base_;
  for (std::uint32_t& stamp : stamps_) {
    stamp = stamp > moved_us ? static_cast<std::uint32_t>(stamp - moved_us) : 0;
  }
  base_ = base;
}

}  // namespace puck
