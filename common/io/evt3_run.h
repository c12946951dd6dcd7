#pragma once

#include <cstddef>
#include <cstdint>

#include "common/events/event.h"
#include "common/events/event_bits.h"
#include "common/io/word_assembler.h"

namespace puck {

/// The types of EVT 3.0's words: their uppermost four bits.
enum class Evt3Type : std::uint32_t {
  kRow = 0x0,
  kColumn = 0x2,
  kVectorBase = 0x3,
  kVector12 = 0x4,
  kVector8 = 0x5,
  kTimeLow = 0x6,
  kContinued4 = 0x7,
  kTimeHigh = 0x8,
  kTrigger = 0xA,
  kImu = 0xD,
  kOther = 0xE,
  kContinued12 = 0xF,
};

/// A run of words that hold nothing unusual: where it has got to, and what its events depend on.
struct Evt3Run {
  static constexpr std::ptrdiff_t kWordBytes = 2;
  static constexpr std::uint32_t kCoordinate = 0x07ff;
  static constexpr std::uint32_t kPayload = 0x0fff;
  static constexpr int kFlagBit = 11;
  /// The offset of an event has 32 bits.
  static constexpr std::int64_t kLongestOffsetUs = 0xffff'ffff;
  /// Events that may be written behind `full`.
  static constexpr std::size_t kMostAtOnce = 12;
  /// Instead of a base, when none is known: every vector ends beyond the last coordinate.
  static constexpr std::uint32_t kNoBase = 0x8000U | kCoordinate;

  const std::byte* next = nullptr;
  const std::byte* end = nullptr;
  Event* out = nullptr;
  const Event* full = nullptr;
  std::uint32_t width = 0;  ///< Of the sensor, px.
  std::uint32_t height = 0;
  std::int64_t offset_us = 0;  ///< Of the low part's beginning, from the packet's start.
  std::uint32_t low_us = 0;
  std::uint32_t row = 0;   ///< The newest row word.
  std::uint32_t base = 0;  ///< The newest vector base, as its word but for the type.

  /// The newest time, as it stands in an event.
  std::uint64_t time() const {
    return event_bits(0, 0, 0, static_cast<std::uint32_t>(offset_us + low_us));
  }

  /// Whether the next word is a row, a column or a vector base, as nearly all words are.
  bool is_next_quiet() const {
    constexpr std::uint32_t kQuiet = 1U << static_cast<std::uint32_t>(Evt3Type::kRow) |
                                     1U << static_cast<std::uint32_t>(Evt3Type::kColumn) |
                                     1U << static_cast<std::uint32_t>(Evt3Type::kVectorBase);
    return (kQuiet >> (load_word<std::uint16_t>(next) >> 12) & 1U) != 0;
  }

  /// Takes the next word. False where the run ends: at a word that is not plain, which is left, or
  /// behind a time that goes back.
  bool take();

 private:
  bool take_vector(std::uint32_t word, std::uint32_t vector_width);
};

/// Takes words until the run ends, it is full, or too few words are left. Many at once; every
/// instruction set gives the same events.
void take_evt3_words(Evt3Run& run);

}  // namespace puck
