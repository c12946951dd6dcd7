#pragma once

#include <chrono>
#include <cstdint>

#include "common/events/timestamp.h"

namespace puck {

/// Sensor time that is due as a recording plays, and the speed that is reached. After falling
/// behind it goes on from where the recording is: late work is not caught up on. One thread.
class PlayClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// Times the recording's pace; 0: as fast as possible.
  void set_speed(double speed) { speed_ = speed; }
  double speed() const { return speed_; }

  /// Playing starts, or goes on, at `time`.
  void start(Timestamp time, Clock::time_point now);

  /// Sensor time that is due, `time` being reached.
  Timestamp due(Timestamp time, Clock::time_point now);

  /// Over the last second or so; 0 before the first 0.3 s.
  double reached_speed() const { return reached_; }

  /// Whether the wanted speed is not reached.
  bool is_too_slow() const { return speed_ > 0 && reached_ > 0 && reached_ < 0.95 * speed_; }

 private:
  double speed_ = 1;
  Timestamp anchor_;
  Clock::time_point anchored_;
  Timestamp measured_from_;
  Clock::time_point measured_since_;
  double reached_ = 0;
};

}  // namespace puck
