#pragma once

#include <cstddef>
#include <cstdint>

#include "common/events/event.h"
#include "common/events/event_bits.h"
#include "common/io/word_assembler.h"

namespace puck {

/// Types of EVT 3.0 words: their upper four bits.
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

/// Decoder state in a run of ordinary words.
struct Evt3Run {
  static constexpr std::ptrdiff_t kWordBytes = 2;
  static constexpr std::uint32_t kCoordinate = 0x07ff;
  static constexpr std::uint32_t kPayload = 0x0fff;
  static constexpr int kFlagBit = 11;
  /// The offset of an event has 32 bits.
  static constexpr std::int64_t kLongestOffsetUs = 0xffff'ffff;
  /// Largest number of events written beyond `full`.
  static constexpr std::size_t kMostAtOnce = 12;
  /// Stands for an unknown base: every vector then ends beyond the last coordinate.
  static constexpr std::uint32_t kNoBase = 0x8000U | kCoordinate;

  const std::byte* next = nullptr;
  const std::byte* end = nullptr;
  Event* out = nullptr;
  const Event* full = nullptr;
  std::uint32_t width = 0;  ///< Of the sensor, px.
  std::uint32_t height = 0;
  std::int64_t offset_us = 0;  ///< Start of the low part, relative to the packet's start.
  std::uint32_t low_us = 0;
  std::uint32_t row = 0;   ///< Newest row word.
  std::uint32_t base = 0;  ///< Newest vector base, as in its word, without the type.

  /// The newest time as the bits of an event.
  std::uint64_t time() const {
    return event_bits(0, 0, 0, static_cast<std::uint32_t>(offset_us + low_us));
  }

  /// Whether the next word is a row, a column, a vector base or a low part of the time, as nearly
  /// all words are.
  bool is_next_quiet() const {
    constexpr std::uint32_t kQuiet = 1U << static_cast<std::uint32_t>(Evt3Type::kRow) |
                                     1U << static_cast<std::uint32_t>(Evt3Type::kColumn) |
                                     1U << static_cast<std::uint32_t>(Evt3Type::kVectorBase) |
                                     1U << static_cast<std::uint32_t>(Evt3Type::kTimeLow);
    return (kQuiet >> (load_word<std::uint16_t>(next) >> 12) & 1U) != 0;
  }

  /// Decodes the next word. Returns false where the run ends: before a word that needs the
  /// decoder's checks, or after a time that goes back.
  bool take();

 private:
  bool take_vector(std::uint32_t word, std::uint32_t vector_width);
};

/// Decodes words until the run ends, it is full, or too few words are left. Vectorised; every
/// instruction set gives the same events.
void take_evt3_words(Evt3Run& run);

}  // namespace puck
