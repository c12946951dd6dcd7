#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/control/sensor_clock_watch.h"
#include "common/messages/clock_offset.h"
#include "common/messages/host_now.h"
#include "common/messages/published_estimate.h"
#include "common/messages/single_publisher.h"

namespace puck {

struct TrackWatchParams {
  std::int64_t dead_man_us = 100'000;         ///< Longest age of a live track.
  std::int64_t max_clock_error_us = 200'000;  ///< Limit for the age of an estimate's utime.
  /// A real camera's clock has a fixed offset to the host's; without one its track is not followed.
  /// A simulated camera may run slower and then has no offset, or may slip on a slow machine, which
  /// it announces by a change of event_utime.
  bool camera_is_real = true;
};

/// Checks on ESTIMATE by the arm itself: whether the track is live, independently of the bridge.
/// One thread.
class TrackWatch {
 public:
  enum class Verdict {
    kUsed,
    kLate,            ///< Late, a duplicate or a replay.
    kOtherPublisher,  ///< Another tracker is followed.
    kClock,           ///< Too old, or from the future, by the sender's clock.
    kClockUnknown,    ///< The tracker's clock is unknown or too uncertain.
    kStale,           ///< A moving puck whose newest event is too old or in the future.
    kMalformed,       ///< Tracking without a finite position, or an impossible sensor time.
  };
  static constexpr std::size_t kVerdicts = 7;

  explicit TrackWatch(const TrackWatchParams& params) : params_(params) {}

  /// `sender`: the clock of the estimate's session.
  Verdict hear(const PublishedEstimate& estimate, const HostNow& now, const SenderClock& sender);

  /// The newest estimate if it tracks a live camera's events, came in time, and its sensor time
  /// agrees with the host's clock and advances (or the puck rests); else null. Repeated estimates,
  /// a tracker on a log, and a camera with a wrong clock are no live track.
  const PublishedEstimate* alive(std::int64_t monotonic_us) const;

  /// Number of used estimates whose sensor time did not advance though the puck moves.
  std::int64_t frozen() const { return frozen_; }
  /// Number of disagreements between the sensor's clock and the host's.
  std::int64_t clock_disagreements() const { return sensor_clock_.disagreements(); }

  /// When one of the newest estimates was published, by our CLOCK_REALTIME, µs, corrected for the
  /// offset of the tracker's clock. Nothing for older ones.
  std::optional<std::int64_t> published_utime(const MessageId& estimate) const;

 private:
  struct Published {
    MessageId id{0, -1};
    std::int64_t utime = 0;
  };
  static constexpr std::size_t kRemembered = 1024;  // 200 ms at the highest rate of estimates

  void follow_sensor_clock(const PublishedEstimate& estimate, std::int64_t monotonic_us);

  TrackWatchParams params_;
  SinglePublisher publisher_;
  std::optional<PublishedEstimate> newest_;
  std::int64_t newest_heard_us_ = 0;  // CLOCK_MONOTONIC
  std::int64_t went_on_us_ = 0;       // CLOCK_MONOTONIC, when sensor time last advanced
  std::int64_t frozen_ = 0;
  SensorClockWatch sensor_clock_;
  std::array<Published, kRemembered> published_{};
};

}  // namespace puck
