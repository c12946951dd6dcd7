#include "common/control/sensor_clock_watch.h"

#include <algorithm>

namespace puck {
namespace {

constexpr double kHeldUpUs = 200'000;
constexpr double kDrift = 0.001;
constexpr std::int64_t kDoubtUs = 1'000'000;
constexpr std::int64_t kLongestDoubtUs = 5'000'000;
constexpr std::int64_t kAgainWithinUs = 30'000'000;

}  // namespace

void SensorClockWatch::restart() {
  newest_.reset();
  ahead_us_.reset();
}

void SensorClockWatch::doubt(std::int64_t us, std::int64_t monotonic_us) {
  restart();
  believed_from_us_ = std::max(believed_from_us_, monotonic_us + us);
}

// A delay that is caught up with disagrees several times, but counts as one disagreement.
void SensorClockWatch::disagree(std::int64_t monotonic_us) {
  const bool goes_on = disagreed_at_us_ && !is_believed(monotonic_us);
  if (!goes_on) {
    const bool again = disagreed_at_us_ && monotonic_us - *disagreed_at_us_ <= kAgainWithinUs;
    doubt_us_ = again ? std::min(2 * doubt_us_, kLongestDoubtUs) : kDoubtUs;
    disagreed_at_us_ = monotonic_us;
    ++disagreements_;
  }
  doubt(doubt_us_, monotonic_us);
}

void SensorClockWatch::see(std::int64_t sensor_us, std::int64_t monotonic_us, bool has_events) {
  // As doubles, since the sensor's time may have any value.
  const double ahead_us = static_cast<double>(sensor_us) - static_cast<double>(monotonic_us);
  const double off_us = ahead_us - ahead_us_.value_or(ahead_us);
  const bool is_back = newest_ && sensor_us < newest_->sensor_us;
  if (is_back || off_us > kHeldUpUs || (has_events && off_us < -kHeldUpUs)) {
    disagree(monotonic_us);
  } else if (has_events && newest_ && ahead_us_) {
    const double drift_us = kDrift * static_cast<double>(monotonic_us - newest_->monotonic_us);
    *ahead_us_ += std::clamp(off_us, -drift_us, drift_us);
  }
  if (has_events && !ahead_us_) ahead_us_ = ahead_us;
  newest_ = Seen{sensor_us, monotonic_us};
}

}  // namespace puck
