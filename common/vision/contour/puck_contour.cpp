#include "common/vision/contour/puck_contour.h"

#include <algorithm>
#include <numbers>

namespace puck {
namespace {

// The smallest semi-axis of a contour that has an inside.
constexpr double kSmallestSemi_px = 2;

}  // namespace

double ContourRing::reach_area(double reach_px) const {
  return std::numbers::pi * (semi_x + reach_px) * (face_semi_y() + reach_px) +
         4 * half_wall * (drawn_out_semi_x() + reach_px);
}

double ContourRing::inside_area(double half_width_px) const {
  return std::numbers::pi * std::max(semi_x - half_width_px, 1.0) *
             std::max(face_semi_y() - half_width_px, 1.0) +
         4 * half_wall * std::max(drawn_out_semi_x() - half_width_px, 1.0);
}

double ContourRing::outside_area(double half_width_px, double reach_px) const {
  return reach_area(reach_px) - reach_area(half_width_px);
}

PuckContour::PuckContour(SensorSize sensor, const PuckSizeModel& size_model,
                         const ContourCalibration& calibration)
    : sensor_(sensor),
      size_model_(size_model),
      calibration_(calibration),
      other_wall_share_(calibration.other_wall_share(size_model)),
      middle_column_((sensor.width - 1) / 2.0),
      tangent_of_twice_lean_(std::tan(2 * calibration.lean_deg * std::numbers::pi / 180)) {
  // On a plane a disc's width shrinks linearly to zero at the horizon.
  if (size_model.is_plane()) horizon_row_ = size_model.horizon_row(middle_column_);
}

ContourRing PuckContour::ring_at(Pixel centre, double wall_share) const {
  const double share = wall_share_at(centre, wall_share);
  const PuckSize size = size_model_.at(centre);
  const double width = size.width + calibration_.grow_px;
  const double silhouette = size.height + calibration_.grow_px;
  const double height = silhouette - share * width;
  ContourRing ring;
  ring.semi_x = std::max(width / 2, kSmallestSemi_px);
  ring.semi_y = std::max(height / 2, kSmallestSemi_px);
  ring.rise = share * width / 2;
  if (share < 0) {
    ring.half_wall = std::clamp(-share * width / 2, 0.0, ring.semi_y - kSmallestSemi_px);
  }
  const double below_horizon = centre.y - horizon_row_.value_or(centre.y);
  if (horizon_row_ && below_horizon > width) {
    // The shear applies to the disc, not to the wall below it.
    const double disc_height = silhouette - size_model_.wall_of_width() * width;
    const double drawn_out = height - 2 * ring.half_wall;
    ring.shear =
        (centre.x - middle_column_) / below_horizon * std::clamp(disc_height / drawn_out, 0.0, 1.0);
  }
  if (tangent_of_twice_lean_ != 0) {
    // An ellipse rotated within its box is a sheared one, and stays within it.
    const double ratio = width / std::max(silhouette, 2 * kSmallestSemi_px);
    const double most =
        std::sqrt(std::max(ring.semi_x * ring.semi_x - kSmallestSemi_px * kSmallestSemi_px, 0.0)) /
        ring.face_semi_y();
    ring.shear =
        std::clamp(ring.shear + tangent_of_twice_lean_ / 2 * (ratio * ratio - 1), -most, most);
  }
  if (ring.shear != 0) {
    const double sheared = ring.shear * ring.face_semi_y();
    ring.semi_x = std::sqrt(std::max(ring.semi_x * ring.semi_x - sheared * sheared,
                                     kSmallestSemi_px * kSmallestSemi_px));
    ring.sides_slope =
        sheared * ring.face_semi_y() / (ring.semi_x * ring.semi_x + sheared * sheared);
  }
  return ring;
}

}  // namespace puck
