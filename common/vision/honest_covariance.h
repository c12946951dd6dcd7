#pragma once

#include <array>

#include "common/vision/contour_filter.h"
#include "common/vision/puck_signature.h"

namespace puck {

/// The covariance that is published, of (x, y, vx, vy), row by row; px², px²/s, px²/s². The filter
/// takes an edge's passing for as many events as a pixel makes of it, each as far off as a single
/// one, which is too careful; what the lag leaves grows with the speed, and the size model and the
/// pixels leave a floor, of neither of which the filter knows.
std::array<double, 16> honest_covariance(const ContourFilter& filter,
                                         const PuckSignature& signature);

}  // namespace puck
