#pragma once

#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/simulation/random.h"
#include "common/simulation/simulated_truth.h"
#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

/// PUCK's errors on the simulated camera's events, preset `default`, camera at rest, from
/// `puck-play --fit-estimate-errors --shots 200 --max-speed 15`. A turn is a hit or a bounce.
struct EstimateErrorParams {
  double sigma_x_px = 0.102;  ///< Of the drifting error.
  double sigma_y_px = 0.109;
  double correlation_us = 6'900;  ///< Until its autocorrelation is 1/e.
  double bias_x_px = 0.001;
  double bias_y_px = 0.160;
  double lag_us = 33;                ///< Behind the puck, at the estimate's time.
  double reported_sigma_px = 0.312;  ///< From the estimate's covariance.
  double detection_us = 9'230;       ///< From the puck's entry to its first track.
  double notice_us = 735;            ///< Time after a turn with a straight prediction …
  double loss_share = 0.034;         ///< … or, after this share of the turns, without a track …
  double loss_us = 5'444;            ///< … for this time on average.
  double strays_per_s = 0;           ///< Rate of outliers anywhere in the image, of 1 ms each.
};

/// Whether the puck was hit or bounced in a step of the world.
bool is_turn(const SimulatedTruth& before, const SimulatedTruth& after);

/// Simulates PUCK's estimates from the true position: adds a drifting error, a lag, and delays and
/// losses after turns. The same seed gives the same errors. One thread.
class EstimateErrors {
 public:
  EstimateErrors(const EstimateErrorParams& params, SensorSize sensor, std::int64_t seed);

  /// Takes the current world; call at every step.
  void watch(const SimulatedTruth& truth);
  /// Of the newest world.
  PuckEstimate estimate() const;

 private:
  void drift(std::int64_t passed_us);
  void turn(Timestamp now);
  void stray(std::int64_t passed_us);

  EstimateErrorParams params_;
  SensorSize sensor_;
  Random random_;
  std::optional<SimulatedTruth> newest_;
  PixelVelocity velocity_;
  double error_x_px_ = 0;
  double error_y_px_ = 0;
  Timestamp seen_from_;     // not tracked before
  Timestamp noticed_from_;  // predicted straight before …
  Timestamp turned_;        // … from the position at this time
  Pixel turned_at_;
  PixelVelocity turned_from_;
  bool was_seen_ = false;
  Pixel stray_at_;
  Timestamp stray_until_;
};

}  // namespace puck
