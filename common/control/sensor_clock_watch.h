#pragma once

#include <cstdint>
#include <optional>

namespace puck {

/// Whether a camera's time goes on as the host's does. One that jumps, goes backwards or runs at
/// another rate (a restarted, broken or forged camera) makes every velocity wrong. It is doubted
/// from then on until its time has agreed for a second; for twice as long each time that it
/// disagrees once more, believed by then, within half a minute, up to 5 s, so that a rate that is
/// wrong by a twentieth is doubted for good. One thread.
///
/// How the clocks stand to each other is measured while a puck is tracked that moves. Sensor time
/// may stay behind as long as none does, since there may be no events, but never runs ahead by more
/// than 200 ms, the time that estimates may be held up on the way, and 0.1 % of drift.
class SensorClockWatch {
 public:
  /// A clock that is not known, or another camera's.
  void restart();
  /// Doubted for `us` from now on, and measured anew.
  void doubt(std::int64_t us, std::int64_t monotonic_us);

  /// The camera says that its time will lag behind by `us` more from now on.
  void slip(double us) {
    if (ahead_us_) *ahead_us_ -= us;
  }

  /// `has_events`: it tracks a puck that moves.
  void see(std::int64_t sensor_us, std::int64_t monotonic_us, bool has_events);

  bool is_believed(std::int64_t monotonic_us) const { return monotonic_us >= believed_from_us_; }
  /// How often it disagreed.
  std::int64_t disagreements() const { return disagreements_; }

 private:
  struct Seen {
    std::int64_t sensor_us = 0;
    std::int64_t monotonic_us = 0;
  };

  void disagree(std::int64_t monotonic_us);

  std::optional<Seen> newest_;
  // The sensor's time less CLOCK_MONOTONIC, as it is believed to be.
  std::optional<double> ahead_us_;
  std::int64_t believed_from_us_ = 0;            // CLOCK_MONOTONIC
  std::int64_t doubt_us_ = 0;                    // how long the newest lasts
  std::optional<std::int64_t> disagreed_at_us_;  // CLOCK_MONOTONIC
  std::int64_t disagreements_ = 0;
};

}  // namespace puck
