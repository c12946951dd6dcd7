#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/evaluation/truth_track.h"
#include "common/events/sensor_size.h"
#include "common/vision/puck_estimate.h"

namespace puck {

/// How far off the estimates of a recording were. Percentages are of the ticks that count.
struct AccuracyReport {
  std::int64_t estimates = 0;  ///< Ticks that count; where there are none, nothing else is known.
  double mean_px = 0;
  double median_px = 0;
  double p95_px = 0;
  double within_2px_percent = 0;
  double within_3p5px_percent = 0;
  double within_4px_percent = 0;
  double lost_percent = 0;
  double longest_loss_ms = 0;
  /// From the puck's first motion to the first tick on which it was tracked within 20 px.
  std::optional<double> time_to_first_track_ms;
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
  };
  /// The ticks that count, for plots.
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  TruthTrack truth_;
  SensorSize sensor_;
  Timestamp motion_;
  std::vector<Sample> samples_;
  std::int64_t lost_ticks_ = 0;
  std::optional<Timestamp> loss_began_;
  std::int64_t longest_loss_us_ = 0;
  std::optional<Timestamp> first_track_;
};

}  // namespace puck
