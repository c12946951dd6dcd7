#pragma once

#include <cstdint>

#include "common/control/arm_back_end.h"

namespace puck {

/// Where the arm's joints are before it is moved: believed when several readings on end agree,
/// since the motion begins there and one reading alone may be wrong. One thread.
class SteadyStart {
 public:
  /// Readings on end that have to agree: 10 ms of a loop of 500 Hz, 100 ms of a board's encoders.
  static constexpr int kReadings = 5;
  /// Encoders of joints at rest differ by less: no joint of these readings by more from the first.
  static constexpr double kAgreeDeg = 0.5;

  void restart() { agreeing_ = 0; }

  /// The newest reading, with finite angles; the same one again counts for nothing. Whether the
  /// newest readings agree.
  bool see(const JointReading& reading);

 private:
  int agreeing_ = 0;
  JointAngles first_;
  std::int64_t newest_us_ = 0;  // CLOCK_MONOTONIC
};

}  // namespace puck
