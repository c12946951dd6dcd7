#pragma once

#include <bit>
#include <cstdint>

#include "common/events/event.h"

namespace puck {

/// The eight bytes of an event as one number, which compilers handle faster in loops than bit
/// fields. `std::bit_cast<Event>` converts it to an event. x and y must be below 2^12, so that
/// adding the bits of another x moves the event to the right.
constexpr std::uint64_t event_bits(std::uint32_t x, std::uint32_t y, std::uint32_t polarity,
                                   std::uint32_t offset_us) {
  if constexpr (std::endian::native == std::endian::little) {
    return std::uint64_t{offset_us} << 32 | (x | y << 16 | polarity << 31);
  } else {
    Event event;
    event.x = static_cast<std::uint16_t>(x);
    event.y = static_cast<std::uint16_t>(y & 0x7fffU);
    event.polarity = static_cast<std::uint16_t>(polarity & 1U);
    event.offset_us = offset_us;
    return std::bit_cast<std::uint64_t>(event);
  }
}
#ifndef __clang__  // Clang's bit_cast of bit fields is not constexpr.
static_assert(std::bit_cast<Event>(event_bits(2047, 2046, 1, 4'000'000'000)) ==
              Event{.x = 2047, .y = 2046, .polarity = 1, .offset_us = 4'000'000'000});
#endif

}  // namespace puck
