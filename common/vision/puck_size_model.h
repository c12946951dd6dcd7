#pragma once

#include "common/vision/pixel.h"

namespace puck {

/// The size of the puck's image as a linear function of where it is: the paper's Equation (2),
/// fitted offline by `fit_puck_size_model`. Sizes are full axes in px, coefficients px and px/px.
struct PuckSizeModel {
  double width_0 = 0;  ///< Width at the image's top left corner.
  double width_x = 0;  ///< Growth of the width along x.
  double width_y = 0;  ///< Growth of the width along y.
  double height_0 = 0;
  double height_x = 0;
  double height_y = 0;

  /// Equation (2). May be extrapolated to anything, so users clamp it to the sizes that they have.
  constexpr PuckSize at(Pixel position) const {
    return {width_0 + width_x * position.x + width_y * position.y,
            height_0 + height_x * position.x + height_y * position.y};
  }
};

}  // namespace puck
