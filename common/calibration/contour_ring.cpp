#include "common/calibration/contour_ring.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr double kSmallestSemiPx = 2;
// Of the height of an ordinary puck, this share of its width is its wall's.
constexpr double kWallOfWidth = 0.165;
// On a plane the width grows at least so much from row to row, px per px.
constexpr double kLeastGrowth = 0.01;

}  // namespace

ContourPlaces::ContourPlaces(SensorSize sensor, const PuckSizeModel& size_model)
    : size_model_(size_model),
      middle_column_((sensor.width - 1) / 2.0),
      is_plane_(size_model.width_y > kLeastGrowth) {
  // There the width has shrunk to nothing.
  if (is_plane_) {
    horizon_row_ =
        -(size_model.width_0 + size_model.width_x * middle_column_) / size_model.width_y;
  }
}

ContourPlace ContourPlaces::at(Pixel centre) const {
  ContourPlace place{size_model_.at(centre)};
  const double below_horizon = centre.y - horizon_row_;
  if (is_plane_ && below_horizon > place.size.width) {
    place.shear = (centre.x - middle_column_) / below_horizon;
  }
  return place;
}

RingOffset ring_offset(const ContourPlace& place, const ContourCalibration& calibration, double dx,
                       double dy) {
  const double width = place.size.width + calibration.grow_px;
  const double silhouette = place.size.height + calibration.grow_px;
  const double wall = calibration.wall_share * width;
  const double b = std::max((silhouette - wall) / 2, kSmallestSemiPx);
  // A wall does not slant.
  const double shear =
      place.shear * std::clamp((silhouette - kWallOfWidth * width) / (2 * b), 0.0, 1.0);
  const double a = std::sqrt(std::max(width * width / 4 - shear * shear * b * b,
                                      kSmallestSemiPx * kSmallestSemiPx));
  const double y = dy + wall / 2;
  const double u = (dx - shear * y) / a;
  const double v = y / b;
  const double rho = std::hypot(u, v);
  // The gradient of rho, times rho.
  const double gx = u / a;
  const double gy = v / b - shear * gx;
  const double slope = std::max(std::hypot(gx, gy), 1e-9);
  return {(rho - 1) * rho / slope, gx / slope, gy / slope};
}

}  // namespace puck
