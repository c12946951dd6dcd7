#include "common/control/steady_start.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

bool agree(const JointAngles& a, const JointAngles& b) {
  return std::equal(
      a.deg().begin(), a.deg().end(), b.deg().begin(), b.deg().end(),
      [](double one, double other) { return std::abs(one - other) <= SteadyStart::kAgreeDeg; });
}

}  // namespace

bool SteadyStart::see(const JointReading& reading) {
  if (agreeing_ > 0 && reading.received_us == newest_us_) return agreeing_ >= kReadings;
  newest_us_ = reading.received_us;
  if (agreeing_ == 0 || !agree(first_, reading.position)) {
    first_ = reading.position;
    agreeing_ = 0;
  }
  agreeing_ = std::min(agreeing_ + 1, kReadings);
  return agreeing_ >= kReadings;
}

}  // namespace puck
