#include "common/vision/contour/soft_ring.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "common/vision/contour/ring_score.h"

namespace puck {
namespace {

// Distances from the ring are linear in a shift only for a short way; after a longer one the ring
// is laid anew.
constexpr double kFarShift_px = 0.5;

}  // namespace

SoftRing::SoftRing(SensorSize sensor, const PeakRefinementParams& refinement,
                   const PuckSizeModel& size_model, const ContourCalibration& calibration,
                   bool other_wall)
    : refinement_(refinement), contour_(sensor, size_model, calibration), other_wall_(other_wall) {
  if (!(refinement_.half_width_px > 0)) {
    throw std::invalid_argument("ring.half_width_px must be above 0, got " +
                                std::to_string(refinement_.half_width_px));
  }
  if (refinement_.iterations < 1) {
    throw std::invalid_argument("ring.iterations must be at least 1, got " +
                                std::to_string(refinement_.iterations));
  }
}

SoftRing::Fit SoftRing::fit(ImageView<const std::uint8_t> picture, const Region& place,
                            Pixel start) {
  Fit fit;
  look(picture, place, start, fit);
  if (std::hypot(fit.peak.shift.x, fit.peak.shift.y) > kFarShift_px) {
    look(picture, place, fit.position, fit);
  }
  fit.score = ring_score(samples_, fit.peak.shift);
  fit.spread_px = ring_spread(samples_, fit.peak.shift);
  return fit;
}

void SoftRing::look(ImageView<const std::uint8_t> picture, const Region& place, Pixel start,
                    Fit& fit) {
  samples_.gather(picture, place, contour_.ring_at(start, contour_.wall_share(other_wall_)), start);
  fit.peak = refine_peak(samples_, refinement_);
  fit.position = {start.x + fit.peak.shift.x, start.y + fit.peak.shift.y};
}

}  // namespace puck
