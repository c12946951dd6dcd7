#pragma once

#include <opencv2/core.hpp>

#include "tools/view/drawing/camera_picture.h"
#include "tools/view/interface/picture_wishes.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// Draws scenes. Keeps its buffers from one picture to the next. One thread.
class ScenePainter {
 public:
  /// The picture of a scene whose sensor is known, BGR, 8 bits, of the wished size; valid until the
  /// next call.
  const cv::Mat& paint(const ViewScene& scene, const PictureWishes& wishes);

 private:
  CameraPicture camera_;
  cv::Mat picture_;
};

}  // namespace puck
