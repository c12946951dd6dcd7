#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/events/event.h"

namespace puck {

/// How wide a strip is that makes windows of this half width cheapest: measured for 3, 5 and 7, for
/// the others the width with the fewest vectors an event.
constexpr int eros_strip_width(int half_width) {
  return half_width == 5 ? 10 : half_width == 6 ? 12 : 8;
}

/// How many strips a window of this half width touches at most.
constexpr int eros_strips_touched(int half_width) {
  const int width = eros_strip_width(half_width);
  return (width - 1 + 2 * half_width + 1 + width - 1) / width;
}

/// How many cache lines, of 64 bytes, a window's part of a strip takes: so long is a mask.
constexpr int eros_mask_lines(int half_width) {
  return ((2 * half_width + 1) * eros_strip_width(half_width) + 63) / 64;
}

/// What apply_eros_events() works on: the memory of ErosStrips.
struct ErosUpdateTarget {
  std::uint8_t* bytes = nullptr;
  std::size_t strip_bytes = 0;
  const std::uint8_t* masks = nullptr;  ///< Aligned to 64 bytes.
  int half_width = 1;                   ///< 1 to 8.
};

/// ErosStrips::apply in vectors, those of the best instruction set that the machine has.
void apply_eros_events(const ErosUpdateTarget& target, std::span<const Event> events);

}  // namespace puck
