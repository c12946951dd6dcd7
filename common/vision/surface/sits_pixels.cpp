#include "common/vision/surface/sits_pixels.h"

#include <algorithm>
#include <cmath>

namespace puck {

SitsPixels::SitsPixels(SensorSize sensor, const SitsParams& params)
    : radius_(params.radius_px),
      highest_(static_cast<std::uint8_t>((2 * radius_ + 1) * (2 * radius_ + 1))),
      stride_(static_cast<std::size_t>(sensor.width + 2 * radius_)),
      // The last window's last row is read in a whole vector.
      pixels_(stride_ * static_cast<std::size_t>(sensor.height + 2 * radius_) + kRow) {
  std::fill_n(window_.begin(), 2 * radius_ + 1, std::uint8_t{1});
}

void SitsPixels::apply(std::span<const Event> events) {
  const int side = 2 * radius_ + 1;
  const std::size_t stride = stride_;
  const std::array<std::uint8_t, kRow> window = window_;
  for (const Event& event : events) {
    std::uint8_t& own = pixels_[offset_of(event.x, event.y)];
    const std::uint8_t lowest = std::max<std::uint8_t>(own, 1);
    std::uint8_t* row = pixels_.data() + event.y * stride + event.x;
    for (int y = 0; y < side; ++y, row += stride) {
      for (std::size_t x = 0; x < kRow; ++x) {
        const std::uint8_t one = row[x] >= lowest ? window[x] : 0;
        row[x] = static_cast<std::uint8_t>(row[x] - one);
      }
    }
    own = highest_;
  }
}

void SitsPixels::clear(const Region& region) {
  for (int y = region.y; y < region.bottom(); ++y) {
    std::fill_n(pixels_.data() + offset_of(region.x, y), std::max(region.width, 0),
                std::uint8_t{0});
  }
}

void SitsPixels::take(const Region& region, SurfaceCounts& out) const {
  out.reset_to_rows(region);
  for (int y = 0; y < region.height; ++y) {
    std::copy_n(pixels_.data() + offset_of(region.x, region.y + y), region.width,
                out.strips.data() + static_cast<std::ptrdiff_t>(y) * region.width);
  }
}

GreyValues SitsPixels::greys() const {
  GreyValues greys{};
  for (std::size_t value = 0; value <= highest_; ++value) {
    greys[value] = static_cast<std::uint8_t>(
        std::lround(255 * static_cast<double>(value) / static_cast<double>(highest_)));
  }
  return greys;
}

std::size_t SitsPixels::offset_of(int x, int y) const {
  return static_cast<std::size_t>(y + radius_) * stride_ + static_cast<std::size_t>(x + radius_);
}

}  // namespace puck
