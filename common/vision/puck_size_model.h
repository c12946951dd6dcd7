#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/vision/disc_model.h"
#include "common/vision/pixel.h"

namespace puck {

/// The size of the puck's image as a function of where it is: the paper's Equation (2), linear and
/// fitted offline by `fit_puck_size_model`, or, where that is known, the disc that it approximates.
/// Sizes are full axes in px, coefficients px and px/px.
struct PuckSizeModel {
  double width_0 = 0;  ///< Width at the image's top left corner.
  double width_x = 0;  ///< Growth of the width along x.
  double width_y = 0;  ///< Growth of the width along y.
  double height_0 = 0;
  double height_x = 0;
  double height_y = 0;

  /// What Equation (2) approximates: where it is right, it is so beyond the annotations, too.
  std::optional<DiscModel> disc;

  /// By what share of its width the contour is lower than all these say: 0; the side wall's, where
  /// that is not seen; below 0 where it is seen and they leave it out.
  double unseen_of_width = 0;

  /// What the puck can measure at all. Away from the annotations the plane goes on to anything,
  /// even below zero; no user ever gets that.
  PuckSize smallest{3, 3};
  PuckSize largest{512, 512};

  /// The sensor that it was fitted for; {0, 0}: not known.
  SensorSize sensor;

  /// The size before it is kept to what the puck can measure.
  PuckSize extrapolated_at(Pixel position) const {
    PuckSize size = disc ? disc->at(position)
                         : PuckSize{width_0 + width_x * position.x + width_y * position.y,
                                    height_0 + height_x * position.x + height_y * position.y};
    size.height -= unseen_of_width * size.width;
    return size;
  }

  /// By what share of its width the side wall makes the puck higher than its face alone; 0 where
  /// the annotations outline the face. Of Equation (2) it is not known: an ordinary puck's.
  double wall_of_width() const { return disc ? disc->wall_of_width() : ordinary_wall(); }

  /// The same for an ordinary puck's wall; of Equation (2) it is not known how the camera is
  /// tilted: 30°.
  double ordinary_wall() const {
    constexpr double kFrom30Degrees = 0.165;
    return disc ? disc->ordinary_wall() : kFrom30Degrees;
  }

  /// Of the width from row to row, px/px.
  double width_growth() const { return disc ? disc->width_y : width_y; }
  /// Where the plane's horizon crosses a column: there the width is nothing. Needs a growth.
  double horizon_row(double column) const {
    const double at_top =
        disc ? disc->width_0 + disc->width_x * column : width_0 + width_x * column;
    return -at_top / width_growth();
  }

  /// The size, from `smallest` to `largest`; what is no number counts as the smallest.
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

/// What a person should know before the model is used on such a sensor, one line each: that it was
/// fitted for another one; where in the image it has to be clamped.
std::vector<std::string> doubts_about(const PuckSizeModel& model, SensorSize sensor);

}  // namespace puck
