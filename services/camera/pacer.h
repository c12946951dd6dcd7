#pragma once

#include <chrono>
#include <cstdint>

#include "common/events/timestamp.h"

namespace puck {

/// Maps sensor times to the host's clock. Reports how late the caller is and, beyond a limit,
/// delays the rest of the plan; it never changes a sensor time.
class Pacer {
 public:
  using Clock = std::chrono::steady_clock;

  /// A longer delay is accepted instead of being caught up with in a burst that no receiver could
  /// handle.
  static constexpr std::chrono::milliseconds kMostToMakeUp{100};

  /// `speed`: sensor time per host time.
  explicit Pacer(double speed) : speed_(speed) {}

  bool is_started() const { return is_started_; }
  /// Sensor time `time` is now.
  void start(Timestamp time, Clock::time_point now);
  /// Requires start() afterwards.
  void set_speed(double speed) { speed_ = speed; }

  Clock::time_point due(Timestamp time) const;
  /// The sensor time that is due at `now`.
  Timestamp time_at(Clock::time_point now) const;

  /// The event due at `time` is handled now: notes its lateness. Returns true if the plan slipped.
  bool note(Timestamp time, Clock::time_point now);

  /// Lateness of the last event by the present plan, µs; 0: in time.
  std::int64_t lateness_us() const { return lateness_us_; }
  /// Total slip of the plan since the start, µs.
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
