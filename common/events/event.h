#pragma once

#include <cstdint>

namespace puck {

/// One event: pixel (x, y) became brighter (polarity 1) or darker (0), `offset_us` after the start
/// of its packet. Eight bytes, because memory bandwidth limits the event rate first.
struct Event {
  std::uint16_t x = 0;
  std::uint16_t y : 15 = 0;
  std::uint16_t polarity : 1 = 0;
  std::uint32_t offset_us = 0;

  friend constexpr bool operator==(const Event&, const Event&) = default;
};
static_assert(sizeof(Event) == 8);

}  // namespace puck
