#pragma once

#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/paper/puck_pipeline.h"

namespace puck {

/// As the paper's text says.
PuckPipelineParams paper_params();
/// As the authors' code ran, without its errors.
PuckPipelineParams reference_params();
/// The paper's method with our improvements.
PuckPipelineParams correlation_params();

/// The authors' fit for 640×480 pixels with the camera at rest. Their annotations, boxes around all
/// of the puck's events, are kAuthorsBoxScale times the contour; these sizes are the contour's, as
/// in every PuckSizeModel. The presets `paper` and `reference` scale the sizes back, so that their
/// kernels are the authors'.
inline constexpr double kAuthorsBoxScale = 1.29;
PuckSizeModel authors_static_size_model();

}  // namespace puck
