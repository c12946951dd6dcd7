#pragma once

#include <cstdint>
#include <random>

#include "common/vision/geometry/image.h"

namespace puck::test {

/// A picture of independent random pixels from 0 to 255.
inline Image<std::uint8_t> noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image<std::uint8_t> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image(x, y) = static_cast<std::uint8_t>(random() % 256);
  }
  return image;
}

}  // namespace puck::test
