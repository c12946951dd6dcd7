#pragma once

#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/table/motion_filter.h"
#include "common/table/puck_track.h"

namespace puck {

struct TrackProbationParams {
  /// A track that begins, comes out of the blue or contradicted itself has to hold for so long
  /// before the arm moves by it, µs. A hit begins no new track.
  std::int64_t probation_us = 15'000;
  double max_speed_m_s = 20;  ///< What moves faster from one place to another is not one puck.
};

/// Whether the arm may move by a track: a tracker can be sure of itself and wrong. Judges what a
/// single estimate does not show: leaps, two pucks by turns, and a velocity that is not that of the
/// positions. A track that is wrong and moves like a puck nobody can tell. One thread.
class TrackProbation {
 public:
  enum class Doubt : std::uint8_t {
    kNone,
    kNew,         ///< On probation.
    kScattered,   ///< Too many outliers.
    kContradicts  ///< The velocity that the tracker says is not that of its positions.
  };

  /// Throws std::invalid_argument that names the key when a value is out of its range.
  explicit TrackProbation(const TrackProbationParams& params);

  /// A measurement, what the filter did with it, and the filter's track then.
  void take(const TableMeasurement& measurement, MeasurementUse use,
            const std::optional<PuckTrack>& track);
  /// The sensor's time begins anew: so does the track.
  void forget();

  Doubt doubt() const;
  bool is_trusted() const { return doubt() == Doubt::kNone; }

  std::int64_t leaps() const { return leaps_; }
  std::int64_t contradictions() const { return contradictions_; }

 private:
  bool continues(const TableMeasurement& start) const;
  void follow_scatter(Timestamp t, bool is_outlier);
  void follow_velocity(const TableMeasurement& measurement, const PuckTrack& track);

  TrackProbationParams params_;
  std::optional<Timestamp> newest_;  // of all measurements
  std::optional<TableMeasurement> newest_good_;
  Timestamp began_;  // the probation
  double outlier_share_ = 0;
  bool is_scattered_ = false;
  std::optional<Timestamp> contradicts_since_;
  bool contradicts_ = false;
  std::int64_t leaps_ = 0;
  std::int64_t contradictions_ = 0;
};

/// `new`, `scattered`, …
const char* to_string(TrackProbation::Doubt doubt);

}  // namespace puck
