#pragma once

#include <algorithm>
#include <cmath>

#include "common/events/sensor_size.h"
#include "common/vision/contour_calibration.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_size_model.h"

namespace puck {

/// Where a pixel lies relative to the puck's contour.
struct ContourOffset {
  double distance_px = 0;  ///< From the nearest contour, positive outside.
  double normal_x = 0;     ///< Unit vector out of the puck there.
  double normal_y = 0;
  int sector = 0;  ///< Which of kContourSectors, seen from the centre.
};

inline constexpr int kContourSectors = 12;

/// The ellipse, drawn out or not, on which a puck's contour events lie: sheared, because a disc on
/// a table that is seen from above and beside the middle is not upright, nor is any that a rolled
/// camera sees.
struct ContourRing {
  double semi_x = 0;  ///< Half the width along a row through the centre, px.
  double semi_y = 0;  ///< Half the height, px.
  double shear = 0;   ///< px along x per px along y.
  double rise = 0;    ///< How far the ring's centre lies above the puck's, px.
  /// Half the length of its straight sides, px: a face with a wall below it is outlined by an
  /// ellipse that is drawn out downwards.
  double half_wall = 0;
  /// Where those begin on the ellipse, px along y per px along x from its centre.
  double sides_slope = 0;

  /// No part of it lies farther than this, px, to either side of its centre.
  double half_width() const { return semi_x + std::abs(shear) * semi_y; }

  /// Half the height of the ellipse that is drawn out, px.
  double face_semi_y() const { return semi_y - half_wall; }
  /// Half the width of that ellipse, px.
  double drawn_out_semi_x() const { return std::hypot(semi_x, shear * face_semi_y()); }
  /// How far below the ellipse's centre that lay, before it was drawn out, which lies at
  /// (dx, ring_y) from the ring's.
  double face_y(double dx, double ring_y) const {
    return ring_y - std::clamp(ring_y - sides_slope * dx, -half_wall, half_wall);
  }

  /// Of a pixel at (dx, dy) from the puck's centre, with the ring larger by `growth_px` all round.
  ContourOffset offset(double dx, double dy, double growth_px) const {
    // Inverted once each: this is done for every event near a track.
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

  /// Area of all that is not farther outside than `reach_px`; of the band within `half_width_px` of
  /// the ring; of what is farther inside than that; and of the band from there to `reach_px`
  /// outside; px².
  double reach_area(double reach_px) const;
  double band_area(double half_width_px) const;
  double inside_area(double half_width_px) const;
  double outside_area(double half_width_px, double reach_px) const;

 private:
  // There ∇ρ has no direction: the distance is −kMiddle / kNoSlope, 10 px inside.
  static constexpr double kMiddle = 1e-8;
  static constexpr double kNoSlope = 1e-9;

  double mean_radius() const {
    return std::sqrt((semi_x * semi_x + face_semi_y() * face_semi_y()) / 2);
  }

  // Without an arc tangent: quarters, and in each the slopes of 30° and 60°.
  static int sector_of(double u, double v) {
    const double au = std::abs(u);
    const double av = std::abs(v);
    const int within = av < 0.57735 * au ? 0 : (av < 1.73205 * au ? 1 : 2);
    const int quarter = (u < 0 ? 1 : 0) + (v < 0 ? 2 : 0);
    return quarter * 3 + within;
  }
};

/// The puck's contour anywhere in the image: from the size model, the contour's calibration, and
/// the horizon that the size model implies.
class PuckContour {
 public:
  PuckContour(SensorSize sensor, const PuckSizeModel& size_model,
              const ContourCalibration& calibration, bool sheared);

  /// `wall_share`: by how much of its width the ring is lower than the puck's silhouette, because
  /// the puck's side wall makes no events; below 0 if it is taller because the annotations leave
  /// the wall out: calibrated_wall_share() or other_wall_share(), a left out wall's as it is in the
  /// image's middle.
  ContourRing ring_at(Pixel centre, double wall_share) const;
  double calibrated_wall_share() const { return calibration_.wall_share; }
  double other_wall_share() const { return other_wall_share_; }
  /// The other wall's is found to be `share`. Tracks go by it from their next decision on.
  void correct_other_wall_share(double share) { other_wall_share_ = share; }
  /// It is what the calibration says again.
  void forget_other_wall_share() { other_wall_share_ = calibration_.other_wall_share(size_model_); }
  /// DiscModel::wall_profile; 1 where the disc is not known.
  double wall_profile(Pixel place) const {
    return size_model_.disc ? size_model_.disc->wall_profile(place) : 1;
  }
  /// Of the other wall, or of the calibrated one.
  double wall_share(bool is_other) const {
    return is_other ? other_wall_share() : calibrated_wall_share();
  }
  /// Whether that is the other wall's.
  bool is_other_wall(double wall_share) const { return wall_share != calibrated_wall_share(); }
  /// Where the puck is if it makes a ring that, with wall share `from`, would be one at `centre`,
  /// but with wall share `to`: the ring stays in its place, the puck's centre does not.
  Pixel centre_with_wall(Pixel centre, double from, double to) const {
    const double share = wall_share_at(centre, to) - wall_share_at(centre, from);
    return {centre.x, centre.y + share * size_at(centre).width / 2};
  }
  SensorSize sensor() const { return sensor_; }
  PuckSize size_at(Pixel centre) const { return size_model_.at(centre); }
  /// Faster than the image of what is fixed to the table while the head turns as it does in play,
  /// px/s, at least 36. It goes with the lens, of which the puck's size in the image's middle tells
  /// for a puck and a distance like those of the paper's table.
  double turning_px_s() const { return turning_px_s_; }
  /// ContourCalibration::behind_px.
  double behind_px(double normal_speed_px_s) const {
    return calibration_.behind_px(normal_speed_px_s);
  }

 private:
  // A wall that the annotations leave out is foreshortened as it is there; the calibrated share is
  // the one that suits all of the image best.
  double wall_share_at(Pixel place, double wall_share) const {
    const bool is_left_out = wall_share < 0 && is_other_wall(wall_share);
    return is_left_out ? std::max(wall_share * wall_profile(place), -kHighestWall) : wall_share;
  }

  SensorSize sensor_;
  PuckSizeModel size_model_;
  ContourCalibration calibration_;
  double other_wall_share_ = 0;
  double middle_column_ = 0;
  double horizon_row_ = 0;
  double turning_px_s_ = 0;
  double tangent_of_twice_lean_ = 0;
  bool sheared_ = false;
};

}  // namespace puck
