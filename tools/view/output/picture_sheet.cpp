#include "tools/view/output/picture_sheet.h"

#include <algorithm>
#include <utility>

#include "tools/view/drawing/palette.h"

namespace puck {
namespace {

constexpr int kGap_px = 4;

int even(int size) { return std::max(2, size / 2 * 2); }

}  // namespace

PictureSheet::PictureSheet(std::vector<PictureWishes> pictures, cv::Size size)
    : pictures_(std::move(pictures)) {
  const int count = static_cast<int>(pictures_.size());
  columns_ = count <= 3 && count != 0 ? count : (count + 1) / 2;
  const int rows = (count + columns_ - 1) / columns_;
  sheet_.create(even(size.height), even(size.width), CV_8UC3);
  sheet_.setTo(palette_of(pictures_.front().theme).quiet);
  for (PictureWishes& wishes : pictures_) {
    wishes.width_px = (sheet_.cols - (columns_ - 1) * kGap_px) / columns_;
    wishes.height_px = (sheet_.rows - (rows - 1) * kGap_px) / rows;
  }
}

void PictureSheet::draw(std::size_t index, const ViewScene& scene) {
  const PictureWishes& wishes = pictures_[index];
  const int column = static_cast<int>(index) % columns_;
  const int row = static_cast<int>(index) / columns_;
  const cv::Rect place(column * (wishes.width_px + kGap_px), row * (wishes.height_px + kGap_px),
                       wishes.width_px, wishes.height_px);
  painter_.paint(scene, wishes).copyTo(sheet_(place & cv::Rect({0, 0}, sheet_.size())));
}

}  // namespace puck
