#include "tools/view/recording/play_clock.h"

#include <cmath>

namespace puck {
namespace {

using std::chrono::duration;

// Falling behind by more moves the anchor.
constexpr double kMostBehind_s = 0.1;
constexpr double kMeasured_s = 0.5;
// Played at once when there is no pace.
constexpr std::int64_t kAsFastAsPossible_us = 10'000;

}  // namespace

void PlayClock::start(Timestamp time, Clock::time_point now) {
  anchor_ = measured_from_ = time;
  anchored_ = measured_since_ = now;
  reached_ = 0;
}

Timestamp PlayClock::due(Timestamp time, Clock::time_point now) {
  const double measured_s = duration<double>(now - measured_since_).count();
  if (measured_s >= kMeasured_s) {
    reached_ = static_cast<double>(time - measured_from_) * 1e-6 / measured_s;
    measured_from_ = time;
    measured_since_ = now;
  }
  if (speed_ <= 0) return time + kAsFastAsPossible_us;
  const double elapsed_s = duration<double>(now - anchored_).count();
  const Timestamp due = anchor_ + std::llround(elapsed_s * speed_ * 1e6);
  if (static_cast<double>(due - time) * 1e-6 > kMostBehind_s * speed_) {
    anchor_ = time;
    anchored_ = now;
    return time + std::llround(kMostBehind_s * speed_ * 1e6);
  }
  return due;
}

}  // namespace puck
