#pragma once

#include <cstddef>
#include <cstdint>

#include "common/events/event.h"
#include "common/io/word_assembler.h"

namespace puck {

/// Records of eight bytes: a time stamp in µs and an address of 32 bits each, in which x, y and
/// polarity lie.
struct StampedLayout {
  struct Field {
    int shift = 0;
    std::uint32_t mask = 0;
    /// The number is counted down from here, in place of up from 0.
    bool is_mirrored = false;
    std::uint32_t last = 0;

    std::uint32_t of(std::uint32_t address) const {
      const std::uint32_t value = address >> shift & mask;
      return is_mirrored ? last - value : value;
    }
  };

  /// False: little-endian, the stamp first. True: big-endian, the address first.
  bool is_big_endian = false;
  /// After so many bits, stamps wrap.
  int stamp_bits = 32;
  /// An address with one of these bits is not an event's.
  std::uint32_t other_bits = 0;
  Field x;
  Field y;
  Field polarity;

  bool is_event(std::uint32_t address) const { return (address & other_bits) == 0; }
  std::uint32_t stamp_mask() const { return 0xffffffffU >> (32 - stamp_bits); }
};

/// The numbers of a record.
struct AddressRecord {
  /// The little-endian number of a record's bytes.
  AddressRecord(const StampedLayout& layout, std::uint64_t record) {
    if (layout.is_big_endian) {
      record = (record & 0x00ff00ff00ff00ffU) << 8 | (record >> 8 & 0x00ff00ff00ff00ffU);
      record = (record & 0x0000ffff0000ffffU) << 16 | (record >> 16 & 0x0000ffff0000ffffU);
      record = record << 32 | record >> 32;
    }
    stamp = static_cast<std::uint32_t>(record) & layout.stamp_mask();
    address = static_cast<std::uint32_t>(record >> 32);
  }
  AddressRecord(const StampedLayout& layout, const std::byte* bytes)
      : AddressRecord(layout, load_word<std::uint64_t>(bytes)) {}

  std::uint32_t stamp = 0;
  std::uint32_t address = 0;
};

/// Decoder state in a run of ordinary records: events within the sensor, whose stamps go on by at
/// most `kLongestStepUs`.
struct StampedRun {
  static constexpr std::ptrdiff_t kRecordBytes = 8;
  static constexpr std::uint32_t kLongestStepUs = 1'000'000;

  const StampedLayout* layout = nullptr;
  const std::byte* next = nullptr;
  const std::byte* end = nullptr;  ///< A whole number of records after `next`.
  Event* out = nullptr;
  const Event* full = nullptr;
  std::uint32_t width = 0;  ///< Of the sensor, px.
  std::uint32_t height = 0;
  std::uint32_t stamp = 0;    ///< Of the newest record.
  std::uint32_t base_us = 0;  ///< What a stamp plus this, modulo 2^32, is after the packet's start.

  /// Whether the record's stamp continues the newest one.
  bool continues(const AddressRecord& record) const {
    return record.stamp >= stamp && record.stamp - stamp <= kLongestStepUs;
  }

  /// Decodes the next record. Returns false where the run ends, before a record that needs the
  /// decoder's checks.
  bool take();
};

/// Decodes records until the run ends, it is full, or no record is left. Vectorised; every
/// instruction set gives the same events.
void take_stamped_records(StampedRun& run);

}  // namespace puck
