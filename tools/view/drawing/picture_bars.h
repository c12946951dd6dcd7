#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "tools/view/drawing/canvas.h"
#include "tools/view/drawing/palette.h"
#include "tools/view/interface/picture_wishes.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// Height of the bar above the camera's picture.
inline constexpr int kTopBar_px = 30;

/// Writes time, tracker, state, error, speed and score into the top bar, from left to right, as far
/// as the width allows.
void write_bar(const ViewScene& scene, const PictureWishes& wishes, Canvas& canvas, int width_px);

struct LegendEntry {
  enum class Sample { kSquare, kRing, kLine, kDashes, kArrow };

  Sample sample;
  cv::Scalar colour;
  std::string words;
};

/// What the wishes show in the camera's picture.
std::vector<LegendEntry> camera_legend(const ViewScene& scene, const PictureWishes& wishes);

/// A legend has as many rows as its entries need.
int legend_height_px(const std::vector<LegendEntry>& entries, int width_px);

/// Draws a legend with its bar at the picture's lower end.
void draw_legend(const std::vector<LegendEntry>& entries, const Palette& palette, cv::Mat& picture);

}  // namespace puck
