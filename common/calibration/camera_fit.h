#pragma once

#include <span>

#include "common/table/correspondence.h"
#include "common/table/homography.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

struct FocalLengthFit {
  double focal_px = 0;
  /// Relative standard deviation of the focal length for an error of 1 px in each marking.
  double sigma_per_px = 0;
  /// Residual in the image with a camera without distortion, with square pixels and the given
  /// principal point. Much larger than the homography's, it shows that the camera does not fit this
  /// model.
  double rms_px = 0;
};

/// Fits the focal length with which a pinhole camera sees the correspondences best, starting from
/// the one that the fitted homography implies. Throws std::invalid_argument with the reason when
/// the correspondences hardly depend on it, as for a camera that looks straight down.
FocalLengthFit fit_focal_length(const Homography& homography, Pixel principal_point,
                                std::span<const Correspondence> correspondences);

}  // namespace puck
