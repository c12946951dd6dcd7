#pragma once

#include <cstdint>
#include <optional>

#include "common/vision/pixel.h"

namespace puck {

/// Where a puck that has left the image may have come back: no farther from where it left than it
/// has glided since, there and back, unless something has hit it out there.
class WayBack {
 public:
  struct Reach {
    Pixel from;
    double radius_px = 0;

    bool contains(Pixel place) const { return distance_px(from, place) <= radius_px; }
  };

  /// It is now beyond the image, next to `edge`, px, and has been so fast, px/s.
  void note_left(Pixel edge, double speed_px_s, std::int64_t time_us);

  /// It is seen in the image, or something else is followed.
  void forget() { left_.reset(); }

  /// None while it has not left.
  std::optional<Reach> reach(std::int64_t time_us) const;

 private:
  struct Left {
    Pixel edge;
    double speed_px_s = 0;
    std::int64_t time_us = 0;
  };

  std::optional<Left> left_;
};

}  // namespace puck
