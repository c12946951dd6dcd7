#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/events/event.h"
#include "common/events/sensor_size.h"

namespace puck {

/// Remembers when each pixel last fired with each sign, to tell the first event of an edge's
/// passing from those that follow it.
class EventHistory {
 public:
  explicit EventHistory(SensorSize sensor)
      : width_(sensor.width),
        last_us_(
            2 * static_cast<std::size_t>(sensor.width) * static_cast<std::size_t>(sensor.height),
            kNever) {}

  /// Fetches what `is_first` will soon need for an event: more is kept than fits the nearest
  /// caches, and fetching it takes longer than all the rest.
  void fetch(const Event& event) const { __builtin_prefetch(&last_us_[index_of(event)], 1); }

  /// Takes an event; true when its pixel has not fired with this sign for 3 ms. Times may go back
  /// by up to a second. For a second, 2³¹ µs (36 minutes) after the first event, pixels that have
  /// never fired are taken to have done so lately; and so is, each 2³² µs, what fired then last.
  bool is_first(const Event& event, std::int64_t time_us) {
    if (!start_us_) start_us_ = time_us;
    const auto now = static_cast<std::uint32_t>(time_us - *start_us_);
    std::uint32_t& last = last_us_[index_of(event)];
    const bool first = now - last + kBack_us > kBack_us + kPassing_us;
    last = now;
    return first;
  }

 private:
  static constexpr std::uint32_t kPassing_us = 3'000;
  static constexpr std::uint32_t kBack_us = 1'000'000;
  static constexpr std::uint32_t kNever = std::uint32_t{1} << 31;

  std::size_t index_of(const Event& event) const {
    const std::size_t pixel = event.y * static_cast<std::size_t>(width_) + event.x;
    return 2 * pixel + event.polarity;
  }

  int width_;
  std::optional<std::int64_t> start_us_;  // of the first event
  std::vector<std::uint32_t> last_us_;    // since then; both signs of a pixel side by side
};

}  // namespace puck
