#pragma once

#include <opencv2/core.hpp>

#include "tools/view/interface/picture_wishes.h"

namespace puck {

/// Colours of a picture, BGR. After Okabe and Ito's palette: distinct for every kind of colour
/// blindness, and each kind of mark also differs by its form.
struct Palette {
  cv::Scalar background;
  cv::Scalar bar;  ///< Behind the words above and below the picture.
  cv::Scalar words;
  cv::Scalar quiet;  ///< Secondary words, borders.
  cv::Scalar brighter;
  cv::Scalar darker;
  cv::Scalar estimate;
  cv::Scalar halo;  ///< Around marks, so that they stand out on any backdrop.
  cv::Scalar trail;
  cv::Scalar truth;
  cv::Scalar region;
  cv::Scalar covariance;
  cv::Scalar doubt;  ///< Words on a doubtful track.
};

const Palette& palette_of(PictureWishes::Theme theme);

/// From `from`, at share 0, to `to`, at 1.
cv::Scalar mixed(const cv::Scalar& from, const cv::Scalar& to, double share);

}  // namespace puck
