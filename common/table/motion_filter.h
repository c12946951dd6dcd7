#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/table/puck_motion.h"
#include "common/table/puck_track.h"

namespace puck {

struct MotionFilterParams {
  /// Added to every measurement's own covariance, for what the tracker does not know of: the
  /// calibration and the puck's height, m.
  double position_sigma_m = 0.002;
  /// Measurements closer in time than this share their errors, so that a tracker at a higher rate
  /// is not trusted more, µs.
  std::int64_t error_memory_us = 2'000;
  double initial_speed_sigma_m_s = 2.0;  ///< Of the velocity, when a track begins.
  /// Measurements further off than so many standard deviations are outliers.
  double gate_sigmas = 4.0;
  /// Outliers for this long without a good measurement are the truth, and the track begins anew: a
  /// mallet has hit the puck, µs.
  std::int64_t restart_after_us = 5'000;
  std::int64_t max_coast_us = 100'000;  ///< Without a good measurement, the track ends after this.
};

/// Where one estimate places the puck on the table.
struct TableMeasurement {
  Timestamp t;
  TablePoint position;
  std::array<double, 4> covariance{};  ///< Of (x, y), row by row, m².
  TableVelocity velocity{};            ///< Used only where a track begins.
  bool resting = false;                ///< The tracker saw that the puck lies still.
  /// Of the velocity, row by row, m²/s²; all zeros where it is not known.
  std::array<double, 4> velocity_covariance{};
};

enum class MeasurementUse : std::uint8_t {
  kUsed,
  kStarted,   ///< A track began, or began anew.
  kOutlier,   ///< Outside the gate.
  kLate,      ///< Not newer than the one before.
  kRejected,  ///< Not finite, or a covariance that is none.
};

/// Kalman filter on the table with PuckMotion as its model: rail bounces happen inside the
/// prediction. Not safe to share between threads.
class MotionFilter {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  explicit MotionFilter(const PuckMotion& motion, const MotionFilterParams& params = {});

  MeasurementUse update(const TableMeasurement& measurement);
  void reset();

  /// The track predicted to `t`. Nothing before the first measurement, before the newest one's
  /// time, and from `max_coast_us` after the last good one on.
  std::optional<PuckTrack> at(Timestamp t) const;
  /// Time of the newest good measurement.
  std::optional<Timestamp> newest() const { return newest_; }

 private:
  void start(const TableMeasurement& measurement);
  void come_to_rest();

  PuckMotion motion_;
  MotionFilterParams params_;
  PuckTrack track_;                  // at newest_
  std::optional<Timestamp> newest_;  // of the good measurements
  Timestamp newest_seen_;            // of all, outliers too
  std::optional<Timestamp> outliers_since_;
};

}  // namespace puck
