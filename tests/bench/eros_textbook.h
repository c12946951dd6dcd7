#pragma once

#include <span>
#include <type_traits>

#include <opencv2/core.hpp>

#include "common/events/event.h"
#include "common/events/sensor_size.h"

namespace puck {

/// EROS in a textbook's form (paper, Algorithm 1), on an OpenCV matrix, for comparison with our
/// surface. Pixel is uint8_t or double. The matrix has a border as wide as the window, which is
/// quicker than clipping at the image's edges.
template <typename Pixel>
class TextbookEros {
  static_assert(std::is_same_v<Pixel, std::uint8_t> || std::is_same_v<Pixel, double>);

 public:
  TextbookEros(SensorSize size, int half_width_px, double decay)
      : half_width_(half_width_px),
        decay_(decay),
        surface_(size.height + 2 * half_width_px, size.width + 2 * half_width_px,
                 cv::DataType<Pixel>::type, cv::Scalar(0)) {}

  void update(std::span<const Event> events) {
    const int side = 2 * half_width_ + 1;
    for (const Event& event : events) {
      cv::Mat window = surface_(cv::Rect(event.x, event.y, side, side));
      window *= decay_;
      surface_.at<Pixel>(event.y + half_width_, event.x + half_width_) = 255;
    }
  }

  Pixel at(int x, int y) const { return surface_.at<Pixel>(y + half_width_, x + half_width_); }

 private:
  int half_width_;
  double decay_;
  cv::Mat surface_;
};

}  // namespace puck
