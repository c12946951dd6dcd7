#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/events/timestamp.h"
#include "common/table/intercept_predictor.h"

namespace puck {

/// Quality of the predictions made a given time before the crossing.
struct PredictionBin {
  double from_s = 0;
  double to_s = 0;
  std::int64_t predictions = 0;  ///< If 0, the other values are undefined.
  double median_m = 0;           ///< Median distance between predicted and true place.
  double p90_m = 0;
  double median_s = 0;  ///< Median difference between predicted and true time.
  double p90_s = 0;
  /// Share of the places within one and two predicted standard deviations. Consistent ones: 68 and
  /// 95 %.
  double within_1_sigma_percent = 0;
  double within_2_sigma_percent = 0;
  double time_within_1_sigma_percent = 0;
  double time_within_2_sigma_percent = 0;
};

struct PredictionReport {
  static constexpr std::size_t kBins = 10;
  static constexpr double kBinS = 0.1;

  std::int64_t crossings = 0;
  std::array<PredictionBin, kBins> direct;   ///< Predicted without a bounce before the crossing.
  std::array<PredictionBin, kBins> bounced;  ///< Predicted with bounces.
  std::array<double, kBins>
      missing_percent{};  ///< Share of the bin's moments without a prediction.
  /// Moments with a predicted crossing within a second that did not come, and all moments with one.
  std::int64_t false_alarms = 0;
  std::int64_t alarms = 0;
};

/// Collects predictions of the puck's crossing of the robot's line, and scores them at the
/// crossing.
class PredictionScore {
 public:
  /// Adds the prediction at `t`. Moments in the order of their times.
  void add(Timestamp t, const std::optional<Intercept>& predicted);
  /// Reports that the puck's centre has crossed the line towards the robot.
  void crossed(Timestamp t, double y_m);
  /// Reports an unpredictable change of the puck's path, such as a mallet's hit: a later crossing
  /// does not score earlier predictions. Predictions whose time has passed are false alarms.
  void interrupted(Timestamp t);

  PredictionReport report() const;

 private:
  struct Prediction {
    Timestamp t;
    std::optional<Intercept> intercept;
  };
  struct Sample {
    double place_m = 0;  // Errors and their standard deviations.
    double sigma_m = 0;
    double time_s = 0;
    double sigma_s = 0;
  };
  using Samples = std::array<std::vector<Sample>, PredictionReport::kBins>;

  static std::array<PredictionBin, PredictionReport::kBins> bins_of(const Samples& samples);

  std::vector<Prediction> pending_;
  Samples direct_;
  Samples bounced_;
  std::array<std::int64_t, PredictionReport::kBins> moments_{};
  std::array<std::int64_t, PredictionReport::kBins> missing_{};
  std::int64_t crossings_ = 0;
  std::int64_t false_alarms_ = 0;
  std::int64_t alarms_ = 0;
};

}  // namespace puck
