#pragma once

#include <chrono>
#include <cstdint>

#include "common/events/timestamp.h"

namespace puck {

/// When, on the host's clock, a sensor time comes. Says how late one is and, when that is hopeless,
/// lets the rest of the plan slip; it never changes a sensor time.
class Pacer {
 public:
  using Clock = std::chrono::steady_clock;

  /// Beyond this, what was missed is given up instead of being made up for in a burst, which no
  /// receiver could take.
  static constexpr std::chrono::milliseconds kMostToMakeUp{100};

  /// `speed`: sensor time that passes in a unit of host time.
  explicit Pacer(double speed) : speed_(speed) {}

  bool is_started() const { return is_started_; }
  /// Sensor time `time` is now.
  void start(Timestamp time, Clock::time_point now);

  Clock::time_point due(Timestamp time) const;

  /// What was due at `time` is being done now: notes how late that is. True when the plan slipped.
  bool note(Timestamp time, Clock::time_point now);

  /// How late the last thing was by the plan as it is now, µs; 0 for in time.
  std::int64_t lateness_us() const { return lateness_us_; }
  /// By how much the plan has slipped since the start, µs.
  std::int64_t slipped_us() const { return slipped_us_; }

 private:
  double speed_;
  bool is_started_ = false;
  Timestamp first_;
  Clock::time_point first_at_;
  std::int64_t lateness_us_ = 0;
  std::int64_t slipped_us_ = 0;
};

}  // namespace puck
