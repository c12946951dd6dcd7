#pragma once

#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/simulation/random.h"
#include "common/simulation/simulated_truth.h"
#include "common/vision/puck_estimate.h"

namespace puck {

/// The errors that PUCK makes on the simulated camera's events, preset `default`, the camera at
/// rest, as `puck-play --fit-estimate-errors --shots 200 --max-speed 15` prints them. A turn is a
/// hit or a bounce.
struct EstimateErrorParams {
  double sigma_x_px = 0.071;  ///< Of the error that drifts …
  double sigma_y_px = 0.094;
  double correlation_us = 9'500;  ///< … and after so long is down to 1/e.
  double bias_x_px = 0.003;
  double bias_y_px = 0.172;
  double lag_us = 44;                ///< Behind the puck, at the time that the estimate is for.
  double reported_sigma_px = 0.178;  ///< As the estimate's covariance says.
  double detection_us = 17'000;      ///< Until a puck that comes into the game is tracked.
  double notice_us = 780;            ///< For so long after a turn the estimate goes straight on …
  double loss_share = 0;             ///< … but after this share of the turns the puck is lost …
  double loss_us = 0;                ///< … for so long on average.
  double strays_per_s = 0;  ///< So often, and for a millisecond, the puck is seen anywhere.
};

/// Whether the puck was hit or bounced between two moments a step of the world apart.
bool is_turn(const SimulatedTruth& before, const SimulatedTruth& after);

/// What PUCK would say of a puck whose place is known: on it go an error that drifts, a lag, and
/// what comes of turns. The same seed makes the same errors. One thread.
class EstimateErrors {
 public:
  EstimateErrors(const EstimateErrorParams& params, SensorSize sensor, std::int64_t seed);

  /// The world as it is now; to be called at every step.
  void watch(const SimulatedTruth& truth);
  /// Of the newest.
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
  Timestamp seen_from_;     // until then it is not tracked
  Timestamp noticed_from_;  // until then it goes straight on …
  Timestamp turned_;        // … from where it was then
  Pixel turned_at_;
  PixelVelocity turned_from_;
  bool was_seen_ = false;
  Pixel stray_at_;
  Timestamp stray_until_;
};

}  // namespace puck
