#pragma once

#include <opencv2/core.hpp>

#include "tools/view/drawing/palette.h"
#include "tools/view/interface/picture_wishes.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// Place of the sensor in a picture: `scale` pixels of the picture for one of the sensor.
struct SensorFrame {
  double scale = 1;
  cv::Point2d origin;  ///< Of the upper left corner of pixel (0, 0).
  cv::Size size_px;

  /// The sensor as large as possible in the middle of a part of the picture.
  static SensorFrame inside(const cv::Rect& part, SensorSize sensor);
  /// A place whose whole numbers are the centres of the sensor's pixels.
  cv::Point2d at(Pixel place) const {
    return origin + cv::Point2d((place.x + 0.5) * scale, (place.y + 0.5) * scale);
  }
  cv::Rect rect() const {
    return {cv::Point(static_cast<int>(origin.x), static_cast<int>(origin.y)), size_px};
  }
};

/// Draws the sensor's picture: the backdrop, the marks of one side's track, and around them a bar
/// with time, state, speed and error and a bar with a legend. Keeps buffers. One thread.
class CameraPicture {
 public:
  /// `picture` has the size that the wishes name and the palette's background.
  void draw(const ViewScene& scene, const PictureWishes& wishes, cv::Mat& picture);

 private:
  void draw_backdrop(const ViewScene& scene, const PictureWishes& wishes, const SensorFrame& frame,
                     cv::Mat& picture);
  // In a corner of the sensor's part of the picture.
  void draw_close_up(const ViewScene& scene, const PictureWishes& wishes, const SensorFrame& frame,
                     cv::Mat& inside);

  cv::Mat pixels_;  // One for each of the sensor's.
  cv::Mat enlarged_;
  cv::Mat close_up_;
};

}  // namespace puck
