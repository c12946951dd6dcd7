#pragma once

#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/simulation/random.h"
#include "common/simulation/simulated_truth.h"
#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

/// A tracker on a frame camera with a global shutter: finds the centre of the puck's motion blur,
/// which is the position at mid-exposure, and knows that time. A frame is read out for one period
/// after its exposure, then processed.
struct FrameTrackerParams {
  double rate_hz = 60;
  double exposure_share = 0.5;  ///< As a share of a period.
  std::int64_t processing_us = 3'000;
  double sigma_px = 0.3;      ///< Position error of a puck at rest …
  double smear_share = 0.05;  ///< … plus this share of the blur's length.
};

/// One thread.
class FrameTracker {
 public:
  /// Throws std::invalid_argument that names the value out of range.
  FrameTracker(const FrameTrackerParams& params, SensorSize sensor, std::int64_t seed);

  /// Takes the current world; call at every step. Returns an estimate when an exposure ends.
  std::optional<PuckEstimate> watch(const SimulatedTruth& truth);

  /// From the end of the exposure to the estimate.
  std::int64_t delay_us() const;

 private:
  PuckEstimate look(std::int64_t middle_us);

  FrameTrackerParams params_;
  SensorSize sensor_;
  Random random_;
  double period_us_ = 0;
  std::int64_t frame_ = 0;  // current or next one
  int samples_ = 0;         // within the exposure
  int seen_ = 0;            // of them with the puck in the image
  double sum_x_px_ = 0;
  double sum_y_px_ = 0;
  Pixel first_;
  Pixel last_;
  PuckSize size_;
};

}  // namespace puck
