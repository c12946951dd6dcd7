#pragma once

#include <cstddef>
#include <cstdint>

#include "common/events/event.h"

namespace puck {

/// Decoder state in a run of the ordinary words of EVT 2.0 and EVT 4.0: events within the sensor,
/// in order, and time words that continue the clock.
struct CdWordRun {
  static constexpr std::ptrdiff_t kWordBytes = 4;
  /// The offset of an event has 32 bits.
  static constexpr std::int64_t kLongestOffsetUs = 0xffff'ffff;
  static constexpr std::uint32_t kLowUs = 0x3f;
  static constexpr std::uint32_t kCoordinate = 0x7ff;
  static constexpr std::uint32_t kHigh = 0x0fff'ffff;

  static std::uint32_t type_of(std::uint32_t word) { return word >> 28; }
  static std::uint32_t low_us_of(std::uint32_t word) { return word >> 22 & kLowUs; }
  static std::uint32_t x_of(std::uint32_t word) { return word >> 11 & kCoordinate; }
  static std::uint32_t y_of(std::uint32_t word) { return word & kCoordinate; }

  const std::byte* next = nullptr;
  const std::byte* end = nullptr;  ///< A whole number of words after `next`.
  Event* out = nullptr;
  const Event* full = nullptr;
  std::uint32_t width = 0;  ///< Of the sensor, px.
  std::uint32_t height = 0;
  std::uint32_t darker = 0;     ///< The type of an event; that of a brighter one follows it.
  std::uint32_t time_type = 0;  ///< The type of a time word.
  std::uint32_t high = 0;       ///< The newest time word, without its type.
  std::int64_t steps = 0;       ///< By which the clock went on.
  std::int64_t offset_us = 0;   ///< Of the newest time word, relative to the packet's start.
  std::uint32_t low_us = 0;     ///< Of the newest event since then.

  /// Decodes the next word. Returns false where the run ends, before a word that needs the
  /// decoder's checks.
  bool take();
};

/// Decodes words until the run ends, it is full, or no word is left. Vectorised; every instruction
/// set gives the same events.
void take_cd_words(CdWordRun& run);

}  // namespace puck
