#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/disc_model.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// Size of the puck in the image as a function of its position: the paper's Equation (2), linear
/// and fitted offline by `fit_puck_size_model`, or, where calibrated, the disc that it
/// approximates. Sizes are full axes in px, coefficients px and px/px.
struct PuckSizeModel {
  double width_0 = 0;  ///< Width at the image's top left corner.
  double width_x = 0;  ///< Growth of the width along x.
  double width_y = 0;  ///< Growth of the width along y.
  double height_0 = 0;
  double height_x = 0;
  double height_y = 0;

  /// The disc that Equation (2) approximates: it extrapolates well beyond the annotations.
  std::optional<DiscModel> disc;

  /// Height that the contour lacks relative to these sizes, as a share of its width: 0; the side
  /// wall's where it makes no events; below 0 where only the annotations leave it out.
  double unseen_of_width = 0;

  /// Limits of a puck's size. Away from the annotations the plane extrapolates to any size, even
  /// below zero; at() clamps.
  PuckSize smallest{3, 3};
  PuckSize largest{512, 512};

  /// The sensor of the fit; {0, 0}: unknown.
  SensorSize sensor;

  /// The size before clamping.
  PuckSize extrapolated_at(Pixel position) const {
    PuckSize size = disc ? disc->at(position)
                         : PuckSize{width_0 + width_x * position.x + width_y * position.y,
                                    height_0 + height_x * position.x + height_y * position.y};
    size.height -= unseen_of_width * size.width;
    return size;
  }

  /// The side wall's contribution to the height, as a share of the width; 0 where the annotations
  /// outline the face only. For Equation (2), which does not tell, an ordinary puck's.
  double wall_of_width() const { return disc ? disc->wall_of_width() : ordinary_wall(); }

  /// The same for an ordinary puck's wall; for Equation (2), which does not tell the camera's tilt,
  /// at 30°.
  double ordinary_wall() const {
    constexpr double kFrom30Degrees = 0.165;
    return disc ? disc->ordinary_wall() : kFrom30Degrees;
  }

  /// Growth of the width from row to row, px/px.
  double width_growth() const { return disc ? disc->width_y : width_y; }
  /// Whether it grows from row to row as on a plane in perspective.
  bool is_plane() const {
    constexpr double kLeastGrowth = 0.01;
    return width_growth() > kLeastGrowth;
  }
  /// The row of the plane's horizon (zero width) in a column. Needs a growth.
  double horizon_row(double column) const {
    const double at_top =
        disc ? disc->width_0 + disc->width_x * column : width_0 + width_x * column;
    return -at_top / width_growth();
  }

  /// The size, clamped to `smallest` … `largest`; NaN becomes the smallest.
  PuckSize at(Pixel position) const {
    const PuckSize size = extrapolated_at(position);
    return {clamped(size.width, smallest.width, largest.width),
            clamped(size.height, smallest.height, largest.height)};
  }

 private:
  static double clamped(double size, double lowest, double highest) {
    return size > lowest ? (size < highest ? size : highest) : lowest;
  }
};

/// Warnings before the model is used with such a sensor, one line each: a fit for another sensor,
/// and places in the image where the size is clamped.
std::vector<std::string> doubts_about(const PuckSizeModel& model, SensorSize sensor);

}  // namespace puck
