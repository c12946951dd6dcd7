#pragma once

#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/table/motion_filter.h"
#include "common/table/puck_track.h"

namespace puck {

struct TrackProbationParams {
  /// Time, µs, that a new track, or one with a jump or a contradiction, must hold before it moves
  /// the arm. A hit starts no new track.
  std::int64_t probation_us = 15'000;
  double max_speed_m_s = 20;  ///< Two places with a higher speed between them are not one puck's.
};

/// Decides whether the arm may move by a track, since a tracker may report a wrong track with a
/// high score. Detects what no single estimate shows: jumps, two alternating pucks, and a velocity
/// that does not match the positions. It cannot detect a wrong track that moves like a puck. One
/// thread.
class TrackProbation {
 public:
  enum class Doubt : std::uint8_t {
    kNone,
    kNew,         ///< On probation.
    kScattered,   ///< Too many outliers.
    kContradicts  ///< The reported velocity does not match the positions.
  };

  /// Throws std::invalid_argument that names the key when a value is out of its range.
  explicit TrackProbation(const TrackProbationParams& params);

  /// Takes a measurement, its use by the filter, and the filter's track then.
  void take(const TableMeasurement& measurement, MeasurementUse use,
            const std::optional<PuckTrack>& track);
  /// The sensor's time starts again, and with it the track.
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
  Timestamp began_;  // start of the probation
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
