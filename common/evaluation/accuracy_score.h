#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/evaluation/covariance_score.h"
#include "common/evaluation/error_statistics.h"
#include "common/evaluation/truth_track.h"
#include "common/events/sensor_size.h"
#include "common/vision/puck_estimate.h"

namespace puck {

/// How far off the estimates of a recording were, and how often the puck was lost.
struct AccuracyReport : ErrorStatistics {
  double lost_percent = 0;
  /// From the first tick on which it is lost to the first on which it is not; time in which the
  /// puck cannot be seen does not count.
  double longest_loss_ms = 0;
  /// From the puck's first motion to the first tick on which it was tracked within 20 px.
  std::optional<double> time_to_first_track_ms;
  /// Of the ticks with known truth, those that are `tracking` and wrong. Nothing without any.
  std::optional<double> said_and_wrong_percent;
  /// Of the ticks from the truth's first row to its last, those whose truth is not known because
  /// its rows are too far apart.
  double truth_gap_percent = 0;
  double settle_ms = 0;  ///< After the first motion: ticks up to there do not count.
  std::optional<CovarianceReport> covariance;  ///< Where the estimates carry one.
};

/// Which ticks count.
struct AccuracyParams {
  /// Truth is known between two of its rows that are at most so far apart, µs, and at each row.
  std::int64_t truth_gap_us = 10'000;
  /// From the puck's first motion on, µs: a tracker may find it in this time. Nothing: 200 ms, or 0
  /// where less than a second of truth follows the first motion.
  std::optional<std::int64_t> settle_us;
};

/// Scores estimates against truth, which is linear between its rows. A tick counts when truth is
/// known there, the puck's centre is in the image and at least half of it is visible, from
/// `settle_us` after it has first moved 5 px; if it never moves so far, after the truth begins.
/// Every such tick counts, whatever the tracker says of itself; one without a position counts as
/// 100 px off. Lost is a tick more than 20 px off or whose state is not `tracking`.
///
/// Said and wrong is a tick with known truth, wherever the puck is and from the first one on, that
/// is `tracking` and more than 20 px off, or `tracking` when the puck has been hidden (less than
/// half of it visible) for more than 50 ms.
class AccuracyScore {
 public:
  AccuracyScore(TruthTrack truth, SensorSize sensor, const AccuracyParams& params = {});

  /// The estimate at a tick. Ticks in the order of their times.
  void add(Timestamp tick, const PuckEstimate& estimate);

  AccuracyReport report() const;

  const TruthTrack& truth() const { return truth_; }

  /// The ticks that count, for plots.
  const std::vector<ScoredEstimate>& samples() const { return samples_; }

 private:
  void judge_what_is_said(Timestamp tick, const TruthRow& truth, const PuckEstimate& estimate);

  TruthTrack truth_;
  SensorSize sensor_;
  std::int64_t truth_gap_us_;
  Timestamp motion_;
  std::int64_t settle_us_;
  std::vector<ScoredEstimate> samples_;
  std::int64_t lost_ticks_ = 0;
  // The newest tick, if it counts and the puck is lost there.
  std::optional<Timestamp> lost_since_;
  std::int64_t loss_us_ = 0;  // How long the present loss has lasted while the puck could be seen.
  std::int64_t longest_loss_us_ = 0;
  std::optional<Timestamp> first_track_;
  std::int64_t gap_ticks_ = 0;
  std::int64_t known_ticks_ = 0;
  std::int64_t wrong_ticks_ = 0;
  std::optional<Timestamp> hidden_since_;
};

}  // namespace puck
