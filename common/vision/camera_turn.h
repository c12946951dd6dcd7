#pragma once

#include <array>
#include <cmath>

#include "common/vision/pixel.h"

namespace puck {

/// How a camera that only turns has turned since the start: where a pixel of now lies in the image
/// of then, however far away what it shows is. The focal length may be rough: it only says by how
/// much more the image's border moves than its middle.
class CameraTurn {
 public:
  /// Small turns, each as the px by which it moves the image: to the side, up and down, and, about
  /// the optical axis, at a focal length from the middle.
  using Steps = std::array<double, 3>;

  CameraTurn(Pixel middle, double focal_px) : middle_(middle), focal_px_(focal_px) {}

  Pixel then_of(Pixel now) const {
    const double x = (now.x - middle_.x) / focal_px_;
    const double y = (now.y - middle_.y) / focal_px_;
    const double depth = turn_[6] * x + turn_[7] * y + turn_[8];
    return {middle_.x + focal_px_ * (turn_[0] * x + turn_[1] * y + turn_[2]) / depth,
            middle_.y + focal_px_ * (turn_[3] * x + turn_[4] * y + turn_[5]) / depth};
  }

  /// The inverse: where a pixel of then lies in the image of now.
  Pixel now_of(Pixel then) const {
    const double x = (then.x - middle_.x) / focal_px_;
    const double y = (then.y - middle_.y) / focal_px_;
    const double depth = turn_[2] * x + turn_[5] * y + turn_[8];
    return {middle_.x + focal_px_ * (turn_[0] * x + turn_[3] * y + turn_[6]) / depth,
            middle_.y + focal_px_ * (turn_[1] * x + turn_[4] * y + turn_[7]) / depth};
  }

  /// By how much a pixel of then moves along x and y for each px of the steps.
  struct Slopes {
    Steps x;
    Steps y;
  };
  Slopes slopes_at(Pixel then) const {
    const double x = (then.x - middle_.x) / focal_px_;
    const double y = (then.y - middle_.y) / focal_px_;
    return {{1 + x * x, x * y, -y}, {x * y, 1 + y * y, x}};
  }

  /// Turns it by so much more.
  void turn(const Steps& steps);

 private:
  Pixel middle_;
  double focal_px_;
  std::array<double, 9> turn_{1, 0, 0, 0, 1, 0, 0, 0, 1};  // rays of then from rays of now
};

}  // namespace puck
