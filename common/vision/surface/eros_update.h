#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/events/event.h"

namespace puck {

/// Width of a strip with which windows of this half width are cheapest: measured for 3, 5 and 7;
/// for the others the width with the fewest vectors an event.
constexpr int eros_strip_width(int half_width) {
  return half_width == 5 ? 10 : half_width == 6 ? 12 : 8;
}

/// Largest number of strips that a window of this half width touches.
constexpr int eros_strips_touched(int half_width) {
  const int width = eros_strip_width(half_width);
  return (width - 1 + 2 * half_width + 1 + width - 1) / width;
}

/// Cache lines of 64 bytes in a mask, which covers a window's part of a strip.
constexpr int eros_mask_lines(int half_width) {
  return ((2 * half_width + 1) * eros_strip_width(half_width) + 63) / 64;
}

/// The memory of ErosStrips, for apply_eros_events().
struct ErosUpdateTarget {
  std::uint8_t* bytes = nullptr;
  std::size_t strip_bytes = 0;
  const std::uint8_t* masks = nullptr;  ///< Aligned to 64 bytes.
  int half_width = 1;                   ///< 1 to 8.
};

/// ErosStrips::apply in vectors of the machine's best instruction set.
void apply_eros_events(const ErosUpdateTarget& target, std::span<const Event> events);

}  // namespace puck
