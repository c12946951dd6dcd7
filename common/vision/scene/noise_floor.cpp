#include "common/vision/scene/noise_floor.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

// Long enough for some tens of events in a part of the image, of a sensor that is noisy at all.
constexpr std::int64_t kCountingPeriod_us = 50'000;
// What has not been decided on for so long may have had no events for want of packets.
constexpr std::int64_t kGap_us = 5'000;
// Until all events come when they are wanted.
constexpr std::int64_t kLeadIn_us = 10'000;
// Even while the head turns, so large a share of the image's parts has hardly an edge in it.
constexpr double kQuietShare = 0.2;
// Of a change, what is believed after each period.
constexpr double kRise = 0.1;
constexpr double kFall = 0.5;
// A part of the image has more events than noise makes: by this factor, so many standard deviations
// of the noise, and so many events. The factor is for parts that are not among the quietest.
constexpr double kActiveFactor = 1.2;
constexpr double kActive_sigma = 6;
constexpr double kActiveEvents = 4;

}  // namespace

NoiseFloor::NoiseFloor(SensorSize sensor)
    : pixels_a_cell_(static_cast<double>(sensor.width) * sensor.height / ImageCells::kCount),
      cells_(sensor) {}

void NoiseFloor::decide(std::int64_t time_us) {
  const std::int64_t passed_us = time_us - decided_us_;
  const bool is_gapless = passed_us < kGap_us;
  counted_us_ = is_gapless ? counted_us_ + passed_us : -kLeadIn_us;
  decided_us_ = time_us;
  if (counted_us_ < 0) counts_ = {};
  if (counted_us_ < 0 || !is_explained()) active_us_ = time_us;
  if (counted_us_ < kCountingPeriod_us) return;
  learn();
  counts_ = {};
  counted_us_ = 0;
}

bool NoiseFloor::is_explained() const {
  const double made = rate_ * pixels_a_cell_ * static_cast<double>(counted_us_);
  const double most = kActiveFactor * made + kActive_sigma * std::sqrt(made) + kActiveEvents;
  return is_known_ && *std::max_element(counts_.begin(), counts_.end()) <= most;
}

void NoiseFloor::learn() {
  const auto quiet =
      counts_.begin() + static_cast<std::ptrdiff_t>(kQuietShare * ImageCells::kCount);
  std::nth_element(counts_.begin(), quiet, counts_.end());
  const double rate = *quiet / (pixels_a_cell_ * static_cast<double>(counted_us_));
  const double gain = !is_known_ ? 1 : (rate > rate_ ? kRise : kFall);
  rate_ += gain * (rate - rate_);
  is_known_ = true;
}

}  // namespace puck
