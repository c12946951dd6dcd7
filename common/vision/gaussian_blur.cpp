#include "common/vision/gaussian_blur.h"

#include <algorithm>
#include <array>

namespace puck {
namespace {

// Binomial weights, in 256ths: what OpenCV takes for five pixels when it chooses sigma itself.
constexpr std::array<int, 5> kWeights{16, 64, 96, 64, 16};

// Mirrors an index about the outermost pixels: −1 → 1, size → size − 2.
int mirrored(int index, int size) {
  if (size == 1) return 0;
  while (index < 0 || index >= size) {
    index = index < 0 ? -index : 2 * (size - 1) - index;
  }
  return index;
}

}  // namespace

void GaussianBlur::apply(ImageView<const std::uint8_t> source, Image<std::uint8_t>& out) {
  const int width = source.width();
  const int height = source.height();
  out.resize(width, height);
  if (source.empty()) return;

  rows_.resize(width, height);
  mirrored_row_.resize(width + 2 * kRadius, 1);
  std::uint8_t* padded = mirrored_row_.row(0);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = source.row(y);
    std::copy_n(from, width, padded + kRadius);
    for (int i = 1; i <= kRadius; ++i) {
      padded[kRadius - i] = from[mirrored(-i, width)];
      padded[kRadius + width - 1 + i] = from[mirrored(width - 1 + i, width)];
    }
    std::uint16_t* to = rows_.row(y);
    for (int x = 0; x < width; ++x) {
      to[x] = static_cast<std::uint16_t>(kWeights[0] * (padded[x] + padded[x + 4]) +
                                         kWeights[1] * (padded[x + 1] + padded[x + 3]) +
                                         kWeights[2] * padded[x + 2]);
    }
  }
  for (int y = 0; y < height; ++y) {
    const std::uint16_t* above2 = rows_.row(mirrored(y - 2, height));
    const std::uint16_t* above1 = rows_.row(mirrored(y - 1, height));
    const std::uint16_t* middle = rows_.row(y);
    const std::uint16_t* below1 = rows_.row(mirrored(y + 1, height));
    const std::uint16_t* below2 = rows_.row(mirrored(y + 2, height));
    std::uint8_t* to = out.row(y);
    for (int x = 0; x < width; ++x) {
      const int sum = kWeights[0] * (above2[x] + below2[x]) +
                      kWeights[1] * (above1[x] + below1[x]) + kWeights[2] * middle[x];
      to[x] = static_cast<std::uint8_t>((sum + (1 << 15)) >> 16);
    }
  }
}

}  // namespace puck
