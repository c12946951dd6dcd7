#include "common/vision/paper/measurement_noise.h"

namespace puck {
namespace {

// Added to the curvature, weighted pixels, so that the variance stays finite without bright pixels.
constexpr double kLeastHold = 0.1;

}  // namespace

PixelVariance measurement_variance(const RefinedPeak& peak, const MeasurementNoiseParams& params) {
  // The inverse of the curvature's matrix: the Cramér–Rao bound of a fit to the bright pixels.
  const double xx = peak.hold_xx + kLeastHold;
  const double yy = peak.hold_yy + kLeastHold;
  const double determinant = xx * yy - peak.hold_xy * peak.hold_xy;
  const double floor = params.floor_px * params.floor_px;
  return {floor + params.pixel_px2 * yy / determinant, floor + params.pixel_px2 * xx / determinant};
}

}  // namespace puck
