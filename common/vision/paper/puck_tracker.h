#pragma once

#include <optional>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/vision/contour/soft_ring.h"
#include "common/vision/correlation/correlation.h"
#include "common/vision/correlation/kernel_bank.h"
#include "common/vision/correlation/weighted_peak.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/geometry/region.h"
#include "common/vision/surface/surface_snapshot.h"

namespace puck {

struct TrackerParams {
  /// Size of ROI_t, in puck sizes.
  double region_factor = 3;
  /// The first ROI_t after a detection, relative to the detected position; empty: the usual ROI_t.
  Region first_region;
  /// Standard deviation of the Gaussian around the last position, in canvas sizes. Larger follows
  /// faster pucks; smaller ignores more objects beside the puck.
  double prior_sigma = 0.5;
  /// Reach of the restricted maximum beyond half the canvas, both sides together, px.
  int reach_margin_px = 2;
  /// The authors' window begins half a canvas before the last position and ends half a canvas and
  /// the margin after it; a centred one shares the margin between both sides.
  bool centred_window = false;
  /// The lowest response in ROI_t is subtracted before the Gaussian weighs the response; otherwise
  /// responses below zero count zero.
  bool shift_to_lowest = true;
  /// The weighted response is rounded to 256 levels, as the authors' code does.
  bool quantised = false;
};

/// Follows the puck from one snapshot to the next: the response of the kernel of the size at the
/// expected place, weighted by a Gaussian around that place, and its maximum within reach (paper,
/// Section III-B, tracking).
class PuckTracker {
 public:
  struct Step {
    Pixel position;
    PuckSize size;     ///< The size model's size there.
    double score = 0;  ///< EllipseKernel::contrast at the nearest pixel, or the soft ring's score.
  };

  /// `ring`, if any, refines the peak between pixels; its score is then the step's. Throws
  /// std::invalid_argument, naming the key, when a parameter is out of range.
  PuckTracker(SensorSize sensor, const TrackerParams& params, const PuckSizeModel& size_model,
              std::optional<SoftRing> ring);

  /// ROI_t around a position, not cut off at the sensor's border, but never larger than the sensor.
  Region whole_region_around(Pixel position, const KernelBank& bank) const;

  /// ROI_t around a position, inside the sensor.
  Region region_around(Pixel position, const KernelBank& bank) const;

  /// The first ROI_t after a detection there, inside the sensor.
  Region first_region_at(Pixel position, const KernelBank& bank) const;

  /// Finds the puck in `region`, near `expected`.
  Step step(const SurfaceSnapshot& surface, const Region& region, Pixel expected,
            const KernelBank& bank);

 private:
  Region window_around(Pixel expected, const EllipseKernel& kernel, const Region& region) const;
  WeightedPeak find_peak(const EllipseKernel& kernel, const Region& region, const Region& window,
                         Pixel centre);
  WeightedWindow weigh(const Region& window, Pixel centre, const EllipseKernel& kernel);

  SensorSize sensor_;
  TrackerParams params_;
  PuckSizeModel size_model_;
  std::optional<SoftRing> ring_;
  Correlation picture_;
  CorrelationMap map_;
  GaussianTable columns_;
  GaussianTable rows_;
  WeightedPeakFinder finder_;
};

}  // namespace puck
