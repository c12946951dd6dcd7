#pragma once

#include <algorithm>
#include <array>

#include "common/events/sensor_size.h"
#include "common/simulation/camera_view.h"
#include "common/simulation/static_scene.h"
#include "common/vision/geometry/image.h"

namespace puck {

/// ln(luminance) of the static scene as the camera sees it in its home pose, each point averaged
/// over the area of one pixel, with a margin for a turned camera. Coordinates are pixels of the
/// home pose; they may be negative in the margin.
class Panorama {
 public:
  struct Margin {
    int x_px = 0;
    int y_px = 0;
  };

  /// Keeps `nodes_per_px` points along each pixel.
  Panorama(const StaticScene& scene, const CameraView& home, SensorSize size, Margin margin,
           int nodes_per_px);

  /// Linear interpolation between the nearest points, clamped at the margin's edge.
  float at(float x, float y) const {
    const float scale = static_cast<float>(nodes_per_px_);
    const float node_x = std::clamp((x + static_cast<float>(margin_.x_px)) * scale, 0.0f,
                                    static_cast<float>(nodes_.width() - 2));
    const float node_y = std::clamp((y + static_cast<float>(margin_.y_px)) * scale, 0.0f,
                                    static_cast<float>(nodes_.height() - 2));
    const int left = static_cast<int>(node_x);
    const int top = static_cast<int>(node_y);
    const float share_x = node_x - static_cast<float>(left);
    const float share_y = node_y - static_cast<float>(top);
    const float* upper = nodes_.row(top) + left;
    const float* lower = nodes_.row(top + 1) + left;
    const float above = upper[0] + share_x * (upper[1] - upper[0]);
    const float below = lower[0] + share_x * (lower[1] - lower[0]);
    return above + share_y * (below - above);
  }

  /// As `at`, for kRun points along a line.
  static constexpr int kRun = 8;
  void along(float x, float y, float step_x, float step_y, std::array<float, kRun>& light) const;

  /// Whether the rectangle (ends included) contains more than one flat tone.
  bool is_busy(float left, float top, float right, float bottom) const;

 private:
  void render(const StaticScene& scene, const CameraView& home);
  void find_busy_cells();

  Margin margin_;
  int nodes_per_px_;
  Image<float> nodes_;
  /// Summed-area table of busy cells; its first row and column are zero.
  Image<int> busy_before_;
};

}  // namespace puck
