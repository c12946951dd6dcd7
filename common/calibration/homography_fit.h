#pragma once

#include <span>

#include "common/table/correspondence.h"
#include "common/table/homography.h"

namespace puck {

struct HomographyFit {
  Homography homography;
  /// Residual between the marked pixels and the mapped table points. About zero with four
  /// correspondences: only more can reveal a mistake.
  double rms_px = 0;
  double max_px = 0;
  /// Residual between the table points and the mapped pixels.
  double rms_m = 0;
  double max_m = 0;
};

/// Normalised direct linear transform, refined by least squares of the distances in the image.
/// Throws std::invalid_argument with the reason when there are fewer than four correspondences, one
/// is not finite, too many are collinear, or they contradict each other so much that some would lie
/// behind the camera.
HomographyFit fit_homography(std::span<const Correspondence> correspondences);

}  // namespace puck
