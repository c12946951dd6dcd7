#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/evaluation/covariance_score.h"
#include "common/evaluation/error_statistics.h"
#include "common/evaluation/truth_track.h"
#include "common/events/sensor_size.h"
#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

/// Position errors of a recording's estimates, and losses of the puck.
struct AccuracyReport : ErrorStatistics {
  double lost_percent = 0;
  /// From the first tick with a lost puck to the first without; time in which the puck is not
  /// visible does not count.
  double longest_loss_ms = 0;
  /// From the puck's first motion to the first tick on which it was tracked within 20 px.
  std::optional<double> time_to_first_track_ms;
  /// Share of the ticks with known truth that are `tracking` and wrong; `std::nullopt` without such
  /// ticks.
  std::optional<double> said_and_wrong_percent;
  /// Share of the ticks, from the truth's first row to its last, without known truth because its
  /// rows are too far apart.
  double truth_gap_percent = 0;
  double settle_ms = 0;  ///< Time after the puck's first motion whose ticks do not count.
  std::optional<CovarianceReport> covariance;  ///< Only if the estimates carry one.
};

/// Rules for the ticks that count.
struct AccuracyParams {
  /// Truth is known at each row, and between two rows at most this far apart, µs.
  std::int64_t truth_gap_us = 10'000;
  /// Time after the puck's first motion in which a tracker may find it, µs. `std::nullopt`: 200 ms,
  /// or 0 where less than a second of truth follows the first motion.
  std::optional<std::int64_t> settle_us;
};

/// Scores estimates against truth, which is linear between its rows. A tick counts when truth is
/// known there, the puck's centre is in the image and at least half of it is visible, from
/// `settle_us` after it has first moved 5 px; if it never moves so far, after the truth begins.
/// Every such tick counts, in any state of the tracker; one without a position counts as 100 px
/// off. A tick is lost when it is more than 20 px off or its state is not `tracking`.
///
/// A tick with known truth is "said and wrong", wherever the puck is and from the first tick on,
/// when it is `tracking` and more than 20 px off, or `tracking` while the puck has been hidden
/// (less than half of it visible) for more than 50 ms.
class AccuracyScore {
 public:
  AccuracyScore(TruthTrack truth, SensorSize sensor, const AccuracyParams& params = {});

  /// Adds the estimate at a tick. Ticks in the order of their times.
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
  // Time of the newest tick, if it counts and the puck is lost there.
  std::optional<Timestamp> lost_since_;
  std::int64_t loss_us_ = 0;  // Duration of the present loss, while the puck was visible.
  std::int64_t longest_loss_us_ = 0;
  std::optional<Timestamp> first_track_;
  std::int64_t gap_ticks_ = 0;
  std::int64_t known_ticks_ = 0;
  std::int64_t wrong_ticks_ = 0;
  std::optional<Timestamp> hidden_since_;
};

}  // namespace puck
