#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/events/timestamp.h"
#include "common/table/intercept_predictor.h"

namespace puck {

/// How good the predictions were that were made so long before the crossing.
struct PredictionBin {
  double from_s = 0;
  double to_s = 0;
  std::int64_t predictions = 0;  ///< Where there are none, nothing else is known.
  double median_m = 0;           ///< Of the distance between predicted and real place.
  double p90_m = 0;
  double median_s = 0;  ///< Of the difference between predicted and real time.
  double p90_s = 0;
  /// Share of the places that lie within one and two of the standard deviations that came with
  /// them. Honest ones: 68 and 95 %.
  double within_1_sigma_percent = 0;
  double within_2_sigma_percent = 0;
  double time_within_1_sigma_percent = 0;
  double time_within_2_sigma_percent = 0;
};

struct PredictionReport {
  static constexpr std::size_t kBins = 10;
  static constexpr double kBinS = 0.1;

  std::int64_t crossings = 0;
  std::array<PredictionBin, kBins> direct;   ///< Without bounces until the crossing, as predicted.
  std::array<PredictionBin, kBins> bounced;  ///< With one or more.
  std::array<double, kBins>
      missing_percent{};  ///< Of the moments in the bin: without a prediction.
  /// Moments at which a crossing was predicted within a second but none came, and all at which one
  /// was.
  std::int64_t false_alarms = 0;
  std::int64_t alarms = 0;
};

/// Collects predictions of where the puck will cross the robot's line, and scores them when it has.
class PredictionScore {
 public:
  /// What is predicted at `t`. Moments in the order of their times.
  void add(Timestamp t, const std::optional<Intercept>& predicted);
  /// The puck's centre has crossed the line towards the robot.
  void crossed(Timestamp t, double y_m);
  /// Something that nobody could know of has changed the puck's way, as a mallet's hit does: what
  /// was predicted before will not be judged by a crossing after it. Predictions that should have
  /// come true already are false alarms.
  void interrupted(Timestamp t);

  PredictionReport report() const;

 private:
  struct Prediction {
    Timestamp t;
    std::optional<Intercept> intercept;
  };
  struct Sample {
    double place_m = 0;  // errors and their standard deviations
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
