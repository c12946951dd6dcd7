#include "common/calibration/hot_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

constexpr std::int64_t kSliceUs = 100'000;
constexpr std::int64_t kShortestRecordingUs = 1'000'000;
constexpr std::uint32_t kFewestEventsOfPixel = 20;
constexpr std::uint32_t kTimesNeighbourhood = 5;
constexpr int kReach = 2;
// Smallest share of active slices, relative to that of a random process of the same rate; an edge
// fires in bursts.
constexpr double kLeastSteadiness = 0.75;

// An edge continues beyond the image's border.
int mirrored(int place, int size) {
  const int inside = place < 0 ? -place : (place >= size ? 2 * (size - 1) - place : place);
  return std::clamp(inside, 0, size - 1);
}

}  // namespace

HotPixelFinder::HotPixelFinder(SensorSize sensor)
    : sensor_(sensor),
      records_(static_cast<std::size_t>(sensor.width) * static_cast<std::size_t>(sensor.height)) {}

void HotPixelFinder::add(const EventPacket& packet) {
  for (const Event& event : packet.events) {
    if (!sensor_.contains(event.x, event.y)) continue;
    const Timestamp time = packet.time_of(event);
    if (!first_) first_ = time;
    last_ = time;
    ++events_;
    PixelRecord& record = records_[index_of(event.x, event.y)];
    ++record.events;
    const std::int64_t slice = (time - *first_) / kSliceUs;
    if (slice != record.last_slice) ++record.active_slices;
    record.last_slice = slice;
  }
}

std::uint32_t HotPixelFinder::neighbourhood_explains(int x, int y) const {
  std::array<std::uint32_t, 3> busiest{};
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx) {
      const int u = mirrored(x + dx, sensor_.width);
      const int v = mirrored(y + dy, sensor_.height);
      if (u == x && v == y) continue;
      const std::uint32_t events = records_[index_of(u, v)].events;
      if (events <= busiest.back()) continue;
      busiest.back() = events;
      std::sort(busiest.begin(), busiest.end(), std::greater<>());
    }
  }
  return busiest.back();
}

HotPixelReport HotPixelFinder::find() const {
  if (!first_ || last_ - *first_ < kShortestRecordingUs) {
    throw std::invalid_argument("hot pixels need a second of events or more, got " +
                                std::to_string(first_ ? (last_ - *first_) / 1000 : 0) + " ms");
  }
  HotPixelReport report;
  report.events = events_;
  report.seconds = static_cast<double>(last_ - *first_) * 1e-6;
  const double slices = static_cast<double>((last_ - *first_) / kSliceUs + 1);
  for (int y = 0; y < sensor_.height; ++y) {
    for (int x = 0; x < sensor_.width; ++x) {
      const PixelRecord& record = records_[index_of(x, y)];
      if (record.events < kFewestEventsOfPixel) continue;
      const double events = record.events;
      const double steady_slices = slices * (1 - std::exp(-events / slices));
      if (record.active_slices < kLeastSteadiness * steady_slices) continue;
      if (events <= kFewestEventsOfPixel + kTimesNeighbourhood * neighbourhood_explains(x, y))
        continue;
      report.pixels.push_back({{x, y}, events / report.seconds, record.active_slices / slices});
      report.hot_events += record.events;
    }
  }
  std::stable_sort(report.pixels.begin(), report.pixels.end(),
                   [](const HotPixel& a, const HotPixel& b) { return a.rate_hz > b.rate_hz; });
  std::vector<std::uint32_t> counts;
  for (const PixelRecord& record : records_) counts.push_back(record.events);
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  report.median_rate_hz = *middle / report.seconds;
  return report;
}

}  // namespace puck
