#pragma once

#include <cstdint>
#include <span>

#include "common/events/event.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// Some rows of FreshPixels, copied for another thread.
struct FreshRows {
  Image<std::uint8_t> masks;  ///< Of the whole sensor: 255 where a pixel has fired of late, else 0.

  /// Makes the pixels of `grey` dark that have not fired of late. It shows `part` of the sensor,
  /// whose rows have been copied.
  void darken_stale(const Region& part, ImageView<std::uint8_t> grey) const;
};

/// Remembers which pixels have fired of late, within the last 24 to 32 ms of sensor time. EROS
/// forgets an edge only when others pass over it, so that where little happens most of it is of
/// long ago, and much of that looks like a puck; but a search is for what makes events now. One
/// thread at a time.
class FreshPixels {
 public:
  explicit FreshPixels(SensorSize sensor);

  /// Takes events of a packet that starts at `start`. All lie inside the sensor. In parts or at
  /// once, it is the same.
  void take(Timestamp start, std::span<const Event> events);

  /// Copies the rows of `region`, which lies inside the sensor.
  void copy_rows(const Region& region, FreshRows& out) const;

 private:
  static constexpr std::uint8_t kFreshPeriods = 4;
  static constexpr std::int64_t kPeriod_us = 8'000;
  // Each period, one part of the rows is looked through, so that no age exceeds a byte.
  static constexpr int kParts = 64;
  static constexpr std::uint8_t kStale = 128;  // an age in periods

  void turn_over(std::int64_t time_us);
  std::uint8_t age(std::uint8_t fired_in) const {
    return static_cast<std::uint8_t>(period_ - fired_in);
  }

  Image<std::uint8_t> fired_in_;  // periods, modulo 256
  std::uint8_t period_ = 0;
  std::int64_t turn_us_ = 0;  // when the next period begins
};

}  // namespace puck
