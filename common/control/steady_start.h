#pragma once

#include <cstdint>

#include "common/control/arm_back_end.h"

namespace puck {

/// Finds the joints' position before the arm moves: several consecutive readings must agree, since
/// the motion starts there and a single reading may be wrong. One thread.
class SteadyStart {
 public:
  /// Consecutive readings that must agree: 10 ms of a loop at 500 Hz, 100 ms of a board's encoders.
  static constexpr int kReadings = 5;
  /// Largest difference of a joint's readings from the first one; joints at rest differ by less.
  static constexpr double kAgreeDeg = 0.5;

  void restart() { agreeing_ = 0; }

  /// Takes the newest reading, with finite angles; a repeated one is ignored. Returns whether the
  /// newest readings agree.
  bool see(const JointReading& reading);

 private:
  int agreeing_ = 0;
  JointAngles first_;
  std::int64_t newest_us_ = 0;  // CLOCK_MONOTONIC
};

}  // namespace puck
