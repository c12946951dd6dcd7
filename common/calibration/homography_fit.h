#pragma once

#include <span>

#include "common/table/correspondence.h"
#include "common/table/homography.h"

namespace puck {

struct HomographyFit {
  Homography homography;
  /// Between the marked pixels and the table points carried into the image. With four
  /// correspondences always about zero: only more can show a mistake.
  double rms_px = 0;
  double max_px = 0;
  /// Between the table points and the marked pixels carried to the table.
  double rms_m = 0;
  double max_m = 0;
};

/// Normalised direct linear transform, refined until the squared distances in the image are
/// smallest. Throws std::invalid_argument with the reason when there are fewer than four
/// correspondences, one is not finite, too many lie on one line, or they contradict each other so
/// much that some would lie behind the camera.
HomographyFit fit_homography(std::span<const Correspondence> correspondences);

}  // namespace puck
