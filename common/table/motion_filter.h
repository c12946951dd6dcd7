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
  /// Systematic errors, which do not average out: of the calibration and the puck's height, m.
  double position_sigma_m = 0.0004;
  /// Measurements closer in time than this share their errors, so that a higher tracker rate does
  /// not give a smaller covariance, µs. In the simulated game errors last for some 8 ms, but are
  /// smaller than PUCK reports: with this value the predicted crossings have consistent
  /// covariances.
  std::int64_t error_memory_us = 3'000;
  /// Of the velocity at a track's start: a tracker needs some ms to follow a hit.
  double initial_speed_sigma_m_s = 5.0;
  /// Gate: measurements further off than this many standard deviations are outliers.
  double gate_sigmas = 4.0;
  /// Outliers that agree with one another for this long replace the track where the puck can have
  /// come to: a mallet has hit it, µs.
  std::int64_t hit_after_us = 2'000;
  /// The same where the puck cannot have come to: it was lost and found, or another puck is seen,
  /// µs.
  std::int64_t jump_after_us = 20'000;
  double fastest_m_s = 20.0;            ///< Limit of the speed after a hit.
  std::int64_t max_coast_us = 100'000;  ///< From the last good measurement to the track's end.
};

enum class MeasurementUse : std::uint8_t {
  kUsed,
  kStarted,   ///< The track started.
  kHit,       ///< The track restarted at a place that the puck can have reached.
  kJumped,    ///< The track restarted elsewhere.
  kOutlier,   ///< Outside the gate.
  kLate,      ///< Older than the history, or of a time that was already measured.
  kRejected,  ///< Not finite, or an invalid covariance.
};

/// Whether the measurement updated the track.
constexpr bool is_good(MeasurementUse use) { return use <= MeasurementUse::kJumped; }

/// Kalman filter on the table with PuckMotion as its model: rail bounces happen inside the
/// prediction. Outliers update a tentative track, which replaces the track once it has lasted. Late
/// measurements are filtered in the order of their times: the newest kHistory are kept, and those
/// after a late one are filtered again, so that the order of arrival does not matter. Not safe to
/// share between threads. No allocation.
class MotionFilter {
 public:
  static constexpr std::size_t kHistory = 64;

  /// Throws std::invalid_argument that names the key when a value is out of range.
  explicit MotionFilter(const PuckMotion& motion, const MotionFilterParams& params = {});

  /// Returns the use made of the measurement, as far as is known now.
  MeasurementUse update(const TableMeasurement& measurement);
  void reset();

  /// The track predicted to `t`. `std::nullopt` before the first measurement, before the time of
  /// the newest good one, and from `max_coast_us` after it on.
  std::optional<PuckTrack> at(Timestamp t) const;
  /// Time of the newest good measurement.
  std::optional<Timestamp> newest() const { return current().newest; }

  /// Number of restarts so far: after hits, and after jumps.
  std::int64_t hits() const { return current().hits; }
  std::int64_t jumps() const { return current().jumps; }

 private:
  /// A track from outliers that agree with one another.
  struct TentativeTrack {
    PuckTrack track;  ///< At `newest`.
    Timestamp since;
    Timestamp newest;
    bool is_near = false;  ///< Whether the puck can have reached its start.
  };
  /// The filter's state after some measurements.
  struct FilterState {
    PuckTrack track;                  ///< At `newest`.
    std::optional<Timestamp> newest;  ///< Time of the newest good measurement.
    Timestamp newest_seen;            ///< Time of the newest measurement.
    std::optional<TentativeTrack> tentative;
    PuckTrail trail;
    std::int64_t hits = 0;
    std::int64_t jumps = 0;
  };
  struct HistoryEntry {
    TableMeasurement measurement;
    FilterState after;
    MeasurementUse use = MeasurementUse::kUsed;
  };

  /// The entries in the order of their times, from 0 to `count_`; the rest is free.
  const HistoryEntry& entry(std::size_t i) const { return entries_[order_[i]]; }
  HistoryEntry& entry(std::size_t i) { return entries_[order_[i]]; }
  const FilterState& current() const {
    return count_ > 0 ? entry(count_ - 1).after : before_history_;
  }
  void filter_from(std::size_t index);
  MeasurementUse filter(FilterState& filtered, const TableMeasurement& measurement) const;
  MeasurementUse update_tentative(FilterState& filtered, const TableMeasurement& measurement,
                                  double shared) const;
  PuckTrack started_track(const TableMeasurement& measurement, const Matrix2& noise) const;
  Matrix2 noise_of(const TableMeasurement& measurement, double shared) const;
  PuckTrack predicted(const PuckTrack& track, Timestamp from, Timestamp to) const;

  PuckMotion motion_;
  MotionFilterParams params_;
  std::array<HistoryEntry, kHistory> entries_{};
  std::array<std::uint8_t, kHistory> order_{};  // Indices of `entries_`.
  std::size_t count_ = 0;
  FilterState before_history_;  // State before the oldest entry.
};

}  // namespace puck
