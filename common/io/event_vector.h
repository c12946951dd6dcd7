#pragma once

#include <cstdint>

#include "common/events/event.h"

namespace puck {

/// Vectors of EVT 2.1 and EVT 3.0, as sensors write them, begin at a multiple of so many pixels.
inline constexpr std::uint32_t kVectorPixels = 32;

/// Whether an event goes into the vector of the one before it: time, row, polarity and block of
/// columns are the same, and it comes after the other, so that a reader returns them in this order.
inline bool continues_vector(const Event& before, const Event& event) {
  return event.offset_us == before.offset_us && event.y == before.y &&
         event.polarity == before.polarity && event.x > before.x &&
         event.x / kVectorPixels == before.x / kVectorPixels;
}

}  // namespace puck
