#include "common/vision/surface/fresh_pixels.h"

#include <algorithm>

namespace puck {

void FreshRows::darken_stale(const Region& part, ImageView<std::uint8_t> grey) const {
  for (int y = 0; y < part.height; ++y) {
    const std::uint8_t* fresh = masks.row(part.y + y) + part.x;
    std::uint8_t* pixels = grey.row(y);
    for (int x = 0; x < part.width; ++x) pixels[x] &= fresh[x];
  }
}

FreshPixels::FreshPixels(SensorSize sensor) : fired_in_(sensor.width, sensor.height) {
  for (int y = 0; y < sensor.height; ++y) std::fill_n(fired_in_.row(y), sensor.width, kStale);
}

void FreshPixels::take(Timestamp start, std::span<const Event> events) {
  for (const Event& event : events) {
    const std::int64_t time_us = (start + event.offset_us).us;
    if (time_us >= turn_us_) turn_over(time_us);
    fired_in_(event.x, event.y) = period_;
  }
}

void FreshPixels::turn_over(std::int64_t time_us) {
  const std::int64_t passed = (time_us - turn_us_) / kPeriod_us + 1;
  turn_us_ += passed * kPeriod_us;
  const int height = fired_in_.height();
  // After more periods than there are parts, all is stale.
  for (std::int64_t i = 0; i < std::min<std::int64_t>(passed, kParts + kFreshPeriods); ++i) {
    ++period_;
    const int part = period_ % kParts;
    for (int y = part * height / kParts; y < (part + 1) * height / kParts; ++y) {
      std::uint8_t* fired_in = fired_in_.row(y);
      const auto stale = static_cast<std::uint8_t>(period_ - kStale);
      for (int x = 0; x < fired_in_.width(); ++x) {
        fired_in[x] = age(fired_in[x]) < kFreshPeriods ? fired_in[x] : stale;
      }
    }
  }
}

void FreshPixels::copy_rows(const Region& region, FreshRows& out) const {
  const int width = fired_in_.width();
  out.masks.resize(width, fired_in_.height());
  for (int y = region.y; y < region.bottom(); ++y) {
    const std::uint8_t* fired_in = fired_in_.row(y);
    std::uint8_t* fresh = out.masks.row(y);
    for (int x = 0; x < width; ++x) fresh[x] = age(fired_in[x]) < kFreshPeriods ? 255 : 0;
  }
}

}  // namespace puck
