#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "common/vision/geometry/image.h"
#include "common/vision/geometry/pixel.h"

namespace puck::test {

/// An ellipse whose rows are shifted by `shear` px along x per px along y.
struct DrawnRing {
  Pixel centre;
  double semi_x = 0;
  double semi_y = 0;
  double shear = 0;
};

/// A bright line about two pixels wide along the part of the ring from `from` to `to`, in turns.
inline Image<std::uint8_t> draw_ring(int width, int height, const DrawnRing& ring, double from = 0,
                                     double to = 1) {
  constexpr double kSigma_px = 0.8;
  Image<std::uint8_t> picture(width, height);
  std::vector<Pixel> points;
  for (double turn = from; turn < to; turn += 0.002) {
    const double angle = turn * 2 * std::numbers::pi;
    const double y = ring.semi_y * std::sin(angle);
    points.push_back(
        {ring.centre.x + ring.semi_x * std::cos(angle) + ring.shear * y, ring.centre.y + y});
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double nearest2 = 1e9;
      for (const Pixel& point : points) {
        const double dx = x - point.x;
        const double dy = y - point.y;
        nearest2 = std::min(nearest2, dx * dx + dy * dy);
      }
      picture(x, y) = static_cast<std::uint8_t>(
          std::lround(255 * std::exp(-nearest2 / (2 * kSigma_px * kSigma_px))));
    }
  }
  return picture;
}

}  // namespace puck::test
