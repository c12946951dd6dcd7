#pragma once

#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/simulation/random.h"
#include "common/simulation/simulated_truth.h"
#include "common/vision/puck_estimate.h"

namespace puck {

/// A tracker on the pictures of a camera with a global shutter: it finds the middle of the puck's
/// smear, which is where the puck was in the middle of the exposure, and knows when that was. The
/// picture is read out for one period after its exposure, and then looked at.
struct FrameTrackerParams {
  double rate_hz = 60;
  double exposure_share = 0.5;  ///< Of a period.
  std::int64_t processing_us = 3'000;
  double sigma_px = 0.3;      ///< Of the puck's place, when it stands …
  double smear_share = 0.05;  ///< … and this part of the smear's length on top.
};

/// One thread.
class FrameTracker {
 public:
  /// Throws std::invalid_argument that names the value that is out of its range.
  FrameTracker(const FrameTrackerParams& params, SensorSize sensor, std::int64_t seed);

  /// The world as it is now; to be called at every step. An estimate when an exposure ends.
  std::optional<PuckEstimate> watch(const SimulatedTruth& truth);

  /// From the end of the exposure to the estimate.
  std::int64_t delay_us() const;

 private:
  PuckEstimate look(std::int64_t middle_us);

  FrameTrackerParams params_;
  SensorSize sensor_;
  Random random_;
  double period_us_ = 0;
  std::int64_t frame_ = 0;  // of which the exposure is awaited or under way
  int samples_ = 0;         // within the exposure
  int seen_ = 0;            // those with the puck in the image
  double sum_x_px_ = 0;
  double sum_y_px_ = 0;
  Pixel first_;
  Pixel last_;
  PuckSize size_;
};

}  // namespace puck
