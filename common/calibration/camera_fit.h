#pragma once

#include <span>

#include "common/table/correspondence.h"
#include "common/table/homography.h"
#include "common/vision/pixel.h"

namespace puck {

struct FocalLengthFit {
  double focal_px = 0;
  /// By how much of itself an error of 1 px in each marking moves it, as a standard deviation.
  double sigma_per_px = 0;
  /// Between the marked pixels and those of a camera without distortion and with square pixels,
  /// whose principal point is the one that was given. Much larger than the homography's, it says
  /// that the camera is not like that.
  double rms_px = 0;
};

/// The focal length with which a pinhole camera sees the correspondences best, sought from what the
/// homography that was fitted to them says of it. Throws std::invalid_argument with the reason when
/// they hardly depend on it, as where the camera looks straight down.
FocalLengthFit fit_focal_length(const Homography& homography, Pixel principal_point,
                                std::span<const Correspondence> correspondences);

}  // namespace puck
