#include "common/vision/surface/fresh_pixels.h"

#include <cstddef>

namespace puck {

void FreshRows::darken_stale(const Region& part, ImageView<std::uint8_t> grey) const {
  for (int y = 0; y < part.height; ++y) {
    const std::uint8_t* fresh = masks.row(part.y + y) + part.x;
    std::uint8_t* pixels = grey.row(y);
    for (int x = 0; x < part.width; ++x) pixels[x] &= fresh[x];
  }
}

FreshPixels::FreshPixels(SensorSize sensor) : periods_left_(sensor.width, sensor.height) {}

void FreshPixels::take(Timestamp start, std::span<const Event> events) {
  for (const Event& event : events) {
    const std::int64_t time_us = (start + event.offset_us).us;
    if (time_us >= turn_us_) turn_over(time_us);
    periods_left_(event.x, event.y) = kPeriods;
  }
}

void FreshPixels::turn_over(std::int64_t time_us) {
  const auto pixels = static_cast<std::ptrdiff_t>(periods_left_.width()) * periods_left_.height();
  for (int i = 0; i < kPeriods && turn_us_ <= time_us; ++i) {
    std::uint8_t* left = periods_left_.row(0);
    for (std::ptrdiff_t k = 0; k < pixels; ++k) left[k] -= left[k] > 0 ? 1 : 0;
    turn_us_ += kPeriod_us;
  }
  turn_us_ = (time_us / kPeriod_us + 1) * kPeriod_us;
}

void FreshPixels::copy_rows(const Region& region, FreshRows& out) const {
  const int width = periods_left_.width();
  out.masks.resize(width, periods_left_.height());
  for (int y = region.y; y < region.bottom(); ++y) {
    const std::uint8_t* left = periods_left_.row(y);
    std::uint8_t* fresh = out.masks.row(y);
    for (int x = 0; x < width; ++x) fresh[x] = left[x] > 0 ? 255 : 0;
  }
}

}  // namespace puck
