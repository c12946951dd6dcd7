#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "tools/view/drawing/scene_painter.h"
#include "tools/view/interface/picture_wishes.h"

namespace puck {

/// Several pictures of one moment in one: up to three side by side in a row. One thread.
class PictureSheet {
 public:
  /// `pictures`: at least one; their sizes are overwritten by their share of the sheet. Both sides
  /// of the sheet become even, as videos need it.
  PictureSheet(std::vector<PictureWishes> pictures, cv::Size size);

  const std::vector<PictureWishes>& pictures() const { return pictures_; }
  cv::Size size() const { return sheet_.size(); }

  /// Draws one of the pictures in its place.
  void draw(std::size_t index, const ViewScene& scene);
  const cv::Mat& sheet() const { return sheet_; }

 private:
  std::vector<PictureWishes> pictures_;
  int columns_;
  ScenePainter painter_;
  cv::Mat sheet_;
};

}  // namespace puck
