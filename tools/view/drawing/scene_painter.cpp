#include "tools/view/drawing/scene_painter.h"

#include <algorithm>

#include "tools/view/drawing/palette.h"
#include "tools/view/drawing/table_picture.h"

namespace puck {
namespace {

PictureWishes clamped(PictureWishes wishes) {
  using W = PictureWishes;
  wishes.side = std::clamp(wishes.side, 0, kViewSides - 1);
  wishes.window_us = std::clamp(wishes.window_us, W::kShortestWindow_us, W::kLongestWindow_us);
  wishes.width_px = std::clamp(wishes.width_px, W::kLeastSide_px, W::kMostSide_px);
  wishes.height_px = std::clamp(wishes.height_px, W::kLeastSide_px, W::kMostSide_px);
  return wishes;
}

}  // namespace

const cv::Mat& ScenePainter::paint(const ViewScene& scene, const PictureWishes& wished) {
  const PictureWishes wishes = clamped(wished);
  picture_.create(wishes.height_px, wishes.width_px, CV_8UC3);
  picture_.setTo(palette_of(wishes.theme).background);
  if (wishes.view == PictureWishes::View::kTable) {
    draw_table(scene, wishes, picture_);
  } else {
    camera_.draw(scene, wishes, picture_);
  }
  return picture_;
}

}  // namespace puck
