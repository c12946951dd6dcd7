#pragma once

#include <algorithm>
#include <cmath>

#include "common/events/sensor_size.h"
#include "common/vision/contour/contour_calibration.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/puck_size_model.h"

namespace puck {

/// Position of a pixel relative to the puck's contour.
struct ContourOffset {
  double distance_px = 0;  ///< From the nearest contour, positive outside.
  double normal_x = 0;     ///< Unit vector out of the puck there.
  double normal_y = 0;
  int sector = 0;  ///< Sector of kContourSectors, seen from the centre.
};

inline constexpr int kContourSectors = 12;

/// The ellipse of a puck's contour events, with straight sides where a wall extends it. It is
/// sheared, because a disc is not upright in the image if the camera is rolled or sees the table
/// from above and beside the middle.
struct ContourRing {
  double semi_x = 0;  ///< Half the width along a row through the centre, px.
  double semi_y = 0;  ///< Half the height, px.
  double shear = 0;   ///< px along x per px along y.
  double rise = 0;    ///< Height of the ring's centre above the puck's, px.
  /// Half the length of the straight sides, px: a face with a wall below it is outlined by an
  /// ellipse that is extended downwards.
  double half_wall = 0;
  /// Start of the straight sides on the ellipse, px along y per px along x from its centre.
  double sides_slope = 0;

  /// Largest distance of the ring to either side of its centre, px.
  double half_width() const { return semi_x + std::abs(shear) * semi_y; }

  /// Half the height of the ellipse without its straight sides, px.
  double face_semi_y() const { return semi_y - half_wall; }
  /// Half the width of that ellipse, px.
  double drawn_out_semi_x() const { return std::hypot(semi_x, shear * face_semi_y()); }
  /// Depth below the ellipse's centre of the point that the straight sides move to (dx, ring_y)
  /// from the ring's centre.
  double face_y(double dx, double ring_y) const {
    return ring_y - std::clamp(ring_y - sides_slope * dx, -half_wall, half_wall);
  }

  /// The point of the ring, from the ring's centre, that is (u, v) on the unit circle whose image
  /// its ellipse is.
  Pixel point(double u, double v) const {
    const double face_y = face_semi_y() * v;
    return {semi_x * u + shear * face_y, face_y + std::copysign(half_wall, face_y)};
  }

  /// Offset of a pixel (dx, dy) from the puck's centre; the ring is `growth_px` larger all round.
  ContourOffset offset(double dx, double dy, double growth_px) const {
    // One inversion each: this runs for every event near a track.
    const double per_a = 1 / (semi_x + growth_px);
    const double per_b = 1 / (face_semi_y() + growth_px);
    const double y = face_y(dx, dy + rise);
    const double u = (dx - shear * y) * per_a;
    const double v = y * per_b;
    const double rho = std::max(std::sqrt(u * u + v * v), kMiddle);
    const double gx = u * per_a;
    const double gy = v * per_b - shear * gx;
    const double per_slope = 1 / (std::sqrt(gx * gx + gy * gy) + kNoSlope);
    // To first order: (ρ − 1) / |∇ρ|.
    return {(rho - 1) * rho * per_slope, gx * per_slope, gy * per_slope, sector_of(u, v)};
  }

  /// Sector of a direction from the centre. Without an arc tangent: quadrants, and in each the
  /// slopes of 30° and 60°.
  static int sector_of(double u, double v) {
    const double au = std::abs(u);
    const double av = std::abs(v);
    const int within = av < 0.57735 * au ? 0 : (av < 1.73205 * au ? 1 : 2);
    const int quarter = (u < 0 ? 1 : 0) + (v < 0 ? 2 : 0);
    return quarter * 3 + within;
  }

  /// Areas, px²: of everything up to `reach_px` outside; of everything farther inside than
  /// `half_width_px`; of the band from that far outside to `reach_px` outside.
  double reach_area(double reach_px) const;
  double inside_area(double half_width_px) const;
  double outside_area(double half_width_px, double reach_px) const;

 private:
  // At the centre ∇ρ has no direction: the distance is −kMiddle / kNoSlope, 10 px inside.
  static constexpr double kMiddle = 1e-8;
  static constexpr double kNoSlope = 1e-9;
};

/// The puck's contour anywhere in the image, from the size model with its horizon and the contour's
/// calibration.
class PuckContour {
 public:
  PuckContour(SensorSize sensor, const PuckSizeModel& size_model,
              const ContourCalibration& calibration);

  /// `wall_share`: height that the ring lacks, as a share of its width, because the puck's side
  /// wall makes no events; below 0 if the ring is taller because the annotations leave the wall
  /// out. Either calibrated_wall_share() or other_wall_share(); an omitted wall's share is that in
  /// the image's middle.
  ContourRing ring_at(Pixel centre, double wall_share) const;
  double calibrated_wall_share() const { return calibration_.wall_share; }
  double other_wall_share() const { return other_wall_share_; }
  /// The other wall's share, or the calibrated one.
  double wall_share(bool is_other) const {
    return is_other ? other_wall_share() : calibrated_wall_share();
  }
  /// Whether the share is the other wall's.
  bool is_other_wall(double wall_share) const { return wall_share != calibrated_wall_share(); }
  /// The puck's centre if a ring, which with wall share `from` belongs to a puck at `centre`, is
  /// that of a puck with wall share `to`.
  Pixel centre_with_wall(Pixel centre, double from, double to) const {
    const double share = wall_share_at(centre, to) - wall_share_at(centre, from);
    return {centre.x, centre.y + share * size_at(centre).width / 2};
  }
  SensorSize sensor() const { return sensor_; }
  PuckSize size_at(Pixel centre) const { return size_model_.at(centre); }
  /// ContourCalibration::behind_px.
  double behind_px(double normal_speed_px_s) const {
    return calibration_.behind_px(normal_speed_px_s);
  }

 private:
  // An omitted wall is foreshortened as at its place; the calibrated share is a fit to the whole
  // image.
  double wall_share_at(Pixel place, double wall_share) const {
    const bool is_left_out = wall_share < 0 && is_other_wall(wall_share);
    if (!is_left_out || !size_model_.disc) return wall_share;
    return std::max(wall_share * size_model_.disc->wall_profile(place), -kHighestWall);
  }

  SensorSize sensor_;
  PuckSizeModel size_model_;
  ContourCalibration calibration_;
  double other_wall_share_ = 0;
  double middle_column_ = 0;
  std::optional<double> horizon_row_;  // of a plane
  double tangent_of_twice_lean_ = 0;
};

}  // namespace puck
