#pragma once

#include <span>

#include "common/events/timestamp.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_size_model.h"

namespace puck {

/// The puck as a person, or the simulator, marked it in a recording.
struct SizeAnnotation {
  Timestamp t;
  Pixel centre;
  PuckSize size;
};

/// How far the fitted sizes lie from the annotated ones, px.
struct SizeResiduals {
  double rms_px = 0;
  double max_px = 0;
};

struct SizeFit {
  PuckSizeModel model;
  SizeResiduals width;
  SizeResiduals height;
};

/// Least squares fit of the paper's Equation (2). Throws std::invalid_argument with the reason when
/// there are fewer than three annotations, one is not finite or has no size, or the centres lie on
/// one line to within a pixel, so that the growth across that line cannot be known.
SizeFit fit_puck_size_model(std::span<const SizeAnnotation> annotations);

}  // namespace puck
