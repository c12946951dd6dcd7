#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/evaluation/covariance_score.h"
#include "common/evaluation/score_curve.h"
#include "common/evaluation/truth_track.h"
#include "common/events/sensor_size.h"
#include "common/vision/puck_estimate.h"

namespace puck {

/// How far off the estimates of a recording were. Percentages are of the ticks that count.
struct AccuracyReport {
  std::int64_t estimates = 0;  ///< Ticks that count; where there are none, nothing else is known.
  double mean_px = 0;
  double median_px = 0;
  double p5_px = 0;
  double p25_px = 0;
  double p75_px = 0;
  double p95_px = 0;
  double max_px = 0;
  double within_2px_percent = 0;
  double within_3p5px_percent = 0;
  double within_4px_percent = 0;
  double lost_percent = 0;
  /// From the first tick on which it is lost to the first on which it is not; time in which the
  /// puck cannot be seen does not count.
  double longest_loss_ms = 0;
  /// From the puck's first motion to the first tick on which it was tracked within 20 px.
  std::optional<double> time_to_first_track_ms;
  std::optional<CovarianceReport> covariance;  ///< Where the estimates carry one.
  ScoreCurve score_curve;
};

/// Scores estimates against truth. A tick counts when the puck's centre is in the image and at
/// least half of it is visible, from 200 ms after it has first moved 5 px; if it never moves so
/// far, from 200 ms after the truth begins. Every such tick counts, whatever the tracker says of
/// itself; one without a position counts as 100 px off. Lost is a tick more than 20 px off or whose
/// state is not `tracking`.
class AccuracyScore {
 public:
  AccuracyScore(TruthTrack truth, SensorSize sensor);

  /// The estimate at a tick. Ticks in the order of their times.
  void add(Timestamp tick, const PuckEstimate& estimate);

  AccuracyReport report() const;

  struct Sample {
    Timestamp tick;
    double error_px = 0;
    double score = 0;
    std::optional<double> nees;  ///< As normalised_error_squared says.
  };
  const TruthTrack& truth() const { return truth_; }

  /// The ticks that count, for plots.
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  TruthTrack truth_;
  SensorSize sensor_;
  Timestamp motion_;
  std::vector<Sample> samples_;
  std::int64_t lost_ticks_ = 0;
  // The newest tick, if it counts and the puck is lost there.
  std::optional<Timestamp> lost_since_;
  std::int64_t loss_us_ = 0;  // How long the present loss has lasted while the puck could be seen.
  std::int64_t longest_loss_us_ = 0;
  std::optional<Timestamp> first_track_;
};

}  // namespace puck
