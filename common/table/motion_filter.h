#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/table/kalman_step.h"
#include "common/table/puck_motion.h"
#include "common/table/puck_track.h"
#include "common/table/puck_trail.h"

namespace puck {

struct MotionFilterParams {
  /// For what the tracker does not know of, and what no number of measurements averages out: the
  /// calibration and the puck's height, m.
  double position_sigma_m = 0.0004;
  /// Measurements closer in time than this share their errors, so that a tracker at a higher rate
  /// is not trusted more, µs. In the simulated game errors last for some 8 ms, but are smaller
  /// than PUCK says: with this the predictions of crossings are as sure as they are good.
  std::int64_t error_memory_us = 3'000;
  /// Of the velocity, when a track begins: a tracker needs some ms itself to follow a hit.
  double initial_speed_sigma_m_s = 5.0;
  /// Measurements further off than so many standard deviations are outliers.
  double gate_sigmas = 4.0;
  /// Outliers that go on from where the puck was and agree with one another for this long are the
  /// truth: a mallet has hit it, µs.
  std::int64_t hit_after_us = 2'000;
  /// The same where the puck cannot have come to: it was lost and found, or another one is seen,
  /// µs.
  std::int64_t jump_after_us = 20'000;
  double fastest_m_s = 20.0;            ///< No hit makes the puck faster.
  std::int64_t max_coast_us = 100'000;  ///< Without a good measurement, the track ends after this.
};

enum class MeasurementUse : std::uint8_t {
  kUsed,
  kStarted,   ///< A track began.
  kHit,       ///< The track began anew from where the puck was.
  kJumped,    ///< The track began anew elsewhere.
  kOutlier,   ///< Outside the gate.
  kLate,      ///< Of a time that is too long ago, or that has been measured already.
  kRejected,  ///< Not finite, or a covariance that is none.
};

/// Whether the track rests on the measurement.
constexpr bool is_good(MeasurementUse use) { return use <= MeasurementUse::kJumped; }

/// Kalman filter on the table with PuckMotion as its model: rail bounces happen inside the
/// prediction. Outliers feed a track of their own, which takes over when it has lasted.
/// Measurements that come late are filtered in their place: the newest kHistory are kept, and what
/// follows a late one is filtered again, so that their order of coming does not matter. Not safe to
/// share between threads; nothing is allocated.
class MotionFilter {
 public:
  static constexpr std::size_t kHistory = 64;

  /// Throws std::invalid_argument that names the key when a value is out of its range.
  explicit MotionFilter(const PuckMotion& motion, const MotionFilterParams& params = {});

  /// What became of the measurement, as far as is known now.
  MeasurementUse update(const TableMeasurement& measurement);
  void reset();

  /// The track predicted to `t`. Nothing before the first measurement, before the newest good one's
  /// time, and from `max_coast_us` after it on.
  std::optional<PuckTrack> at(Timestamp t) const;
  /// Time of the newest good measurement.
  std::optional<Timestamp> newest() const { return current().newest; }

  /// How often the track began anew since the start, where the puck was and elsewhere.
  std::int64_t hits() const { return current().hits; }
  std::int64_t jumps() const { return current().jumps; }

 private:
  /// What outliers say, should they be right.
  struct Doubt {
    PuckTrack track;  ///< At `newest`.
    Timestamp since;
    Timestamp newest;
    bool is_near = false;  ///< Where the puck can have come to.
  };
  /// All that the measurements up to a moment say.
  struct Belief {
    PuckTrack track;                  ///< At `newest`.
    std::optional<Timestamp> newest;  ///< Of the good ones.
    Timestamp newest_seen;            ///< Of all.
    std::optional<Doubt> doubt;
    PuckTrail trail;
    std::int64_t hits = 0;
    std::int64_t jumps = 0;
  };
  struct Moment {
    TableMeasurement measurement;
    Belief after;
    MeasurementUse use = MeasurementUse::kUsed;
  };

  const Belief& current() const { return count_ > 0 ? moments_[count_ - 1].after : before_; }
  void filter_from(std::size_t index);
  MeasurementUse filter(Belief& belief, const TableMeasurement& measurement) const;
  MeasurementUse follow_doubt(Belief& belief, const TableMeasurement& measurement,
                              double shared) const;
  PuckTrack begun(const TableMeasurement& measurement, const Matrix2& noise) const;
  Matrix2 noise_of(const TableMeasurement& measurement, double shared) const;
  PuckTrack predicted(const PuckTrack& track, Timestamp from, Timestamp to) const;

  PuckMotion motion_;
  MotionFilterParams params_;
  std::array<Moment, kHistory> moments_{};  // in the order of their times
  std::size_t count_ = 0;
  Belief before_;  // the first of them
};

}  // namespace puck
