#include "services/camera/pacer.h"

#include <algorithm>
#include <cmath>

namespace puck {

using std::chrono::duration_cast;
using std::chrono::microseconds;

void Pacer::start(Timestamp time, Clock::time_point now) {
  is_started_ = true;
  first_ = time;
  first_at_ = now;
}

Pacer::Clock::time_point Pacer::due(Timestamp time) const {
  // Times of a recording may have any value; the host's clock ends after 292 years.
  constexpr double kNever_us = 1e15;
  const double after_us = static_cast<double>(time - first_) / speed_;
  return first_at_ + microseconds(std::llround(std::min(after_us, kNever_us)));
}

Timestamp Pacer::time_at(Clock::time_point now) const {
  const auto after_us = static_cast<double>(duration_cast<microseconds>(now - first_at_).count());
  return first_ + std::llround(after_us * speed_);
}

bool Pacer::note(Timestamp time, Clock::time_point now) {
  const auto late = duration_cast<microseconds>(now - due(time));
  lateness_us_ = std::max<std::int64_t>(0, late.count());
  if (late <= kMostToMakeUp) return false;
  first_at_ += late;
  slipped_us_ += late.count();
  lateness_us_ = 0;
  return true;
}

}  // namespace puck
