#pragma once

#include <cstdint>
#include <optional>

namespace puck {

/// Checks a camera's clock against the host's. A clock that jumps, goes backwards or runs at
/// another rate (a restarted, broken or forged camera) makes every velocity wrong. After a
/// disagreement the clock is distrusted for 1 s. Each further disagreement within 30 s after it was
/// trusted again doubles that time, up to 5 s, so that a rate that is wrong by 5 % stays
/// distrusted. One thread.
///
/// The offset is measured while a moving puck is tracked. Otherwise sensor time may stay behind,
/// since there may be no events, but it never runs ahead by more than 200 ms, the longest delay of
/// estimates on the way, and 0.1 % of drift.
class SensorClockWatch {
 public:
  /// Forgets the offset, for an unknown clock or another camera's.
  void restart();
  /// Distrusts the clock for `us` from now on and measures the offset again.
  void doubt(std::int64_t us, std::int64_t monotonic_us);

  /// The camera announced that its time lags by `us` more from now on.
  void slip(double us) {
    if (ahead_us_) *ahead_us_ -= us;
  }

  /// `has_events`: a moving puck is tracked.
  void see(std::int64_t sensor_us, std::int64_t monotonic_us, bool has_events);

  bool is_believed(std::int64_t monotonic_us) const { return monotonic_us >= believed_from_us_; }
  /// Number of disagreements.
  std::int64_t disagreements() const { return disagreements_; }

 private:
  struct Seen {
    std::int64_t sensor_us = 0;
    std::int64_t monotonic_us = 0;
  };

  void disagree(std::int64_t monotonic_us);

  std::optional<Seen> newest_;
  // Estimated offset: sensor time minus CLOCK_MONOTONIC.
  std::optional<double> ahead_us_;
  std::int64_t believed_from_us_ = 0;            // CLOCK_MONOTONIC
  std::int64_t doubt_us_ = 0;                    // duration of the newest distrust
  std::optional<std::int64_t> disagreed_at_us_;  // CLOCK_MONOTONIC
  std::int64_t disagreements_ = 0;
};

}  // namespace puck
