#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/control/sensor_clock_watch.h"
#include "common/messaging/channels.h"
#include "common/messaging/clock_offset.h"
#include "common/messaging/host_now.h"
#include "common/messaging/single_publisher.h"

namespace puck {

struct TrackWatchParams {
  std::int64_t dead_man_us = 100'000;         ///< A track that ages this long is dead.
  std::int64_t max_clock_error_us = 200'000;  ///< Of an estimate's utime, by its sender's clock.
  /// A real camera's time has a place on the host's clock, and keeps it; else it is not followed.
  /// A simulated one may run slower, and has none, or slip on a machine that is too slow for it,
  /// and says so by moving the place (event_utime).
  bool camera_is_real = true;
};

/// The arm's own look at ESTIMATE: whether the track is alive, whatever the bridge says. One
/// thread.
class TrackWatch {
 public:
  enum class Verdict {
    kUsed,
    kLate,            ///< Late, a duplicate or a replay.
    kOtherPublisher,  ///< Another tracker is followed.
    kClock,           ///< Old, or from the future, by its own clock.
    kClockUnknown,    ///< The tracker's clock is not known, or not well enough.
    kStale,           ///< Of a puck that moves, but as it was long ago, or will be.
    kMalformed,       ///< Tracking, but without a finite position, or of a time that cannot be.
  };
  static constexpr std::size_t kVerdicts = 7;

  explicit TrackWatch(const TrackWatchParams& params) : params_(params) {}

  /// `sender`: the clock of the estimate's session.
  Verdict hear(const puck_estimate_t& estimate, const HostNow& now, const SenderClock& sender);

  /// The newest estimate, if it tracks a live camera's events, came in time, and the sensor's time
  /// went on beneath it or the puck rests, and goes on as ours does: the same estimate said again
  /// and again is not a track, nor is what a tracker sees in a log, or by a camera whose time is
  /// none.
  const puck_estimate_t* alive(std::int64_t monotonic_us) const;

  /// How many of those used said the same as before, of a puck that does not rest.
  std::int64_t frozen() const { return frozen_; }
  /// How often the sensor's time went otherwise than ours.
  std::int64_t clock_disagreements() const { return sensor_clock_.disagreements(); }

  /// When one of the newest estimates was published, by our CLOCK_REALTIME, µs: corrected for the
  /// offset of the tracker's clock.
  std::optional<std::int64_t> published_utime(std::int64_t session, std::int64_t seq) const;

 private:
  struct Published {
    std::int64_t session = 0;
    std::int64_t seq = -1;
    std::int64_t utime = 0;
  };
  static constexpr std::size_t kRemembered = 1024;  // 200 ms at the highest rate of estimates

  void follow_sensor_clock(const puck_estimate_t& estimate, std::int64_t monotonic_us);

  TrackWatchParams params_;
  SinglePublisher publisher_;
  std::optional<puck_estimate_t> newest_;
  std::int64_t newest_heard_us_ = 0;  // CLOCK_MONOTONIC
  std::int64_t went_on_us_ = 0;       // CLOCK_MONOTONIC, when sensor time last went on
  std::int64_t frozen_ = 0;
  SensorClockWatch sensor_clock_;
  std::array<Published, kRemembered> published_{};
};

}  // namespace puck
