#include "common/vision/surface/sae_pixels.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

// Time constants until a grey value of 255 is less than 1/2: ln(2 · 255).
constexpr double kDarkAfter = 6.24;

}  // namespace

SaePixels::SaePixels(SensorSize sensor, const SaeParams& params)
    : width_(sensor.width),
      time_constant_us_(static_cast<double>(params.time_constant_us)),
      tick_bits_(static_cast<int>(std::ceil(std::log2(kDarkAfter * time_constant_us_ / 255)))),
      last_(static_cast<std::size_t>(sensor.width) * static_cast<std::size_t>(sensor.height)) {}

void SaePixels::apply(Timestamp start, std::span<const Event> events) {
  for (const Event& event : events) {
    const std::size_t pixel = event.y * static_cast<std::size_t>(width_) + event.x;
    last_[pixel] = tick_of(start.us + event.offset_us);
  }
}

void SaePixels::clear(const Region& region) {
  for (int y = region.y; y < region.bottom(); ++y) {
    std::fill_n(last_.data() + static_cast<std::ptrdiff_t>(y) * width_ + region.x,
                std::max(region.width, 0), std::uint32_t{0});
  }
}

void SaePixels::take(const Region& region, Timestamp now, SurfaceCounts& out) const {
  out.reset_to_rows(region);
  const std::uint32_t tick = tick_of(now.us);
  std::uint8_t* to = out.strips.data();
  for (int y = region.y; y < region.bottom(); ++y, to += region.width) {
    const std::uint32_t* last = last_.data() + static_cast<std::ptrdiff_t>(y) * width_ + region.x;
    for (int x = 0; x < region.width; ++x) {
      to[x] = static_cast<std::uint8_t>(255 - std::min<std::uint32_t>(tick - last[x], 255));
    }
  }
}

GreyValues SaePixels::greys() const {
  GreyValues greys{};
  for (int age = 0; age < 255; ++age) {
    const double age_us = std::ldexp(age, tick_bits_);
    greys[static_cast<std::size_t>(255 - age)] =
        static_cast<std::uint8_t>(std::lround(255 * std::exp(-age_us / time_constant_us_)));
  }
  return greys;
}

std::uint32_t SaePixels::tick_of(std::int64_t time_us) const {
  // Later than that of pixels that never fired.
  return static_cast<std::uint32_t>((time_us >> tick_bits_) + 256);
}

}  // namespace puck
