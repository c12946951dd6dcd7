#include "common/io/evt3_run.h"

#include <array>
#include <bit>
#include <cstring>
#include <utility>

// The rest of the file, up to the namespace's end, is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/io/evt3_run.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PUCK_COMMON_IO_EVT3_RUN_ONCE
#define PUCK_COMMON_IO_EVT3_RUN_ONCE
namespace puck {
namespace {

constexpr int kWordsAtOnce = 8;

/// Byte indices for a shuffle of eight words.
using Lookup = std::array<std::uint8_t, 2 * kWordsAtOnce>;
/// Index that gives 0.
constexpr std::uint8_t kNowhere = 0x80;

struct alignas(16) Lookups {
  std::array<Lookup, 256> newest{};  ///< For each word, the last masked word up to it.
  std::array<Lookup, 256> packed{};  ///< The masked words, compacted.
};

constexpr Lookups make_lookups() {
  Lookups all;
  for (std::size_t mask = 0; mask < 256; ++mask) {
    std::uint8_t newest = kNowhere;
    std::size_t packed = 0;
    for (std::size_t word = 0; word < kWordsAtOnce; ++word) {
      const auto first_byte = static_cast<std::uint8_t>(2 * word);
      if ((mask >> word & 1U) != 0) {
        newest = first_byte;
        all.packed[mask][packed++] = first_byte;
        all.packed[mask][packed++] = static_cast<std::uint8_t>(first_byte + 1);
      }
      all.newest[mask][2 * word] = newest;
      all.newest[mask][2 * word + 1] =
          newest == kNowhere ? kNowhere : static_cast<std::uint8_t>(newest + 1);
    }
  }
  return all;
}
constexpr Lookups kLookups = make_lookups();

/// The set bits of a four-bit mask: their number, and their offsets as event bits.
struct Steps {
  std::uint32_t count = 0;
  std::array<std::uint64_t, 4> bits{};  // Unused ones are 0.
};

constexpr std::array<Steps, 16> make_steps() {
  std::array<Steps, 16> all{};
  for (std::uint32_t mask = 0; mask < 16; ++mask) {
    for (std::uint32_t x = 0; x < 4; ++x) {
      if ((mask >> x & 1U) != 0) all[mask].bits[all[mask].count++] = event_bits(x, 0, 0, 0);
    }
  }
  return all;
}
constexpr std::array<Steps, 16> kSteps = make_steps();

inline void store(std::uint64_t bits, Event* out) {
  std::memcpy(static_cast<void*>(out), &bits, sizeof bits);
}

/// Writes the events of a vector whose first pixel is `first`; returns the end of them. Branchless:
/// it always writes four at a time, so up to 12 places are touched.
inline Event* put_vector(std::uint64_t first, std::uint32_t mask, Event* out) {
  for (std::uint32_t x = 0; x < 12; x += 4) {
    const Steps& steps = kSteps[mask >> x & 0xfU];
    const std::uint64_t first_of_four = first + event_bits(x, 0, 0, 0);
    for (std::size_t i = 0; i < 4; ++i) store(first_of_four + steps.bits[i], out + i);
    out += steps.count;
  }
  return out;
}

}  // namespace

inline bool Evt3Run::take() {
  const std::uint32_t word = load_word<std::uint16_t>(next);
  const std::uint32_t x = word & kCoordinate;
  const std::uint32_t y = row & kCoordinate;
  switch (static_cast<Evt3Type>(word >> 12)) {
    case Evt3Type::kRow:
      row = word;
      break;
    case Evt3Type::kColumn:
      if (x >= width || y >= height) return false;
      store(time() + event_bits(x, y, word >> kFlagBit & 1U, 0), out++);
      break;
    case Evt3Type::kVectorBase:
      base = word;
      break;
    case Evt3Type::kVector12:
      if (!take_vector(word, 12)) return false;
      break;
    case Evt3Type::kVector8:
      if (!take_vector(word, 8)) return false;
      break;
    case Evt3Type::kTimeLow: {
      const std::uint32_t old_low_us = std::exchange(low_us, word & kPayload);
      next += kWordBytes;
      // A time that goes back needs `take`, and so does one too long after the packet's start.
      return low_us >= old_low_us && offset_us + low_us <= kLongestOffsetUs;
    }
    default:
      return false;
  }
  next += kWordBytes;
  return true;
}

inline bool Evt3Run::take_vector(std::uint32_t word, std::uint32_t vector_width) {
  const std::uint32_t x = base & kCoordinate;
  const std::uint32_t y = row & kCoordinate;
  // The base must stay within the bits of a coordinate.
  const std::uint32_t behind = x + vector_width;
  if (behind > width || behind > kCoordinate || y >= height) return false;
  out = put_vector(time() + event_bits(x, y, base >> kFlagBit & 1U, 0),
                   word & ((1U << vector_width) - 1), out);
  base += vector_width;
  return true;
}

}  // namespace puck
#endif

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
using Words = hn::Full128<std::uint16_t>;
using SignedWords = hn::RebindToSigned<Words>;
using Bytes = hn::Repartition<std::uint8_t, Words>;
using SignedBytes = hn::RebindToSigned<Bytes>;
using Pairs = hn::Repartition<std::uint32_t, Words>;
using WordVector = hn::Vec<Words>;

template <typename Mask>
HWY_INLINE std::uint32_t bits_of(Mask mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Words(), mask, bits);
  return bits[0];
}

HWY_INLINE WordVector look_up(WordVector words, const Lookup& lookup) {
  const Bytes tag;
  return hn::BitCast(
      Words(), hn::TableLookupBytesOr0(hn::BitCast(tag, words), hn::LoadU(tag, lookup.data())));
}

// All bits of the words whose index gives 0.
HWY_INLINE WordVector left_out(const Lookup& lookup) {
  const auto indices = hn::BitCast(SignedBytes(), hn::LoadU(Bytes(), lookup.data()));
  return hn::BitCast(Words(), hn::BroadcastSignBit(indices));
}

// Stores the last masked word of the next ones, if there is one.
HWY_INLINE void keep_newest(const std::byte* next, std::uint32_t mask, std::uint32_t& newest) {
  const int last = std::bit_width(mask | 1U) - 1;
  const std::uint32_t word = load_word<std::uint16_t>(next + last * Evt3Run::kWordBytes);
  newest = mask != 0 ? word : newest;
}

// Writes eight events; a place holds the lower 32 bits of each. Their times are `low` after
// `high_us`.
HWY_INLINE void put_events(WordVector x, WordVector y, WordVector low, std::uint32_t high_us,
                           Event* out) {
  const auto put = [&](hn::Vec<Pairs> places, hn::Vec<Pairs> low_us, Event* to) HWY_ATTR {
    const auto offset = hn::Add(low_us, hn::Set(Pairs(), high_us));
    auto* words = reinterpret_cast<std::uint8_t*>(to);
    hn::StoreU(hn::BitCast(Bytes(), hn::InterleaveLower(Pairs(), places, offset)), Bytes(), words);
    hn::StoreU(hn::BitCast(Bytes(), hn::InterleaveUpper(Pairs(), places, offset)), Bytes(),
               words + 16);
  };
  const auto lower = [](WordVector one, WordVector other) HWY_ATTR {
    return hn::BitCast(Pairs(), hn::InterleaveLower(Words(), one, other));
  };
  const auto upper = [](WordVector one, WordVector other) HWY_ATTR {
    return hn::BitCast(Pairs(), hn::InterleaveUpper(Words(), one, other));
  };
  const auto zero = hn::Zero(Words());
  put(lower(x, y), lower(low, zero), out);
  put(upper(x, y), upper(low, zero), out + 4);
}

// Of each word the newest one of some type up to it, of which `bits` count; before the first of
// them, `before`.
HWY_INLINE WordVector newest_of(WordVector word, const Lookup& newest, std::uint32_t before,
                                std::uint32_t bits) {
  const Words tag;
  const auto earlier = hn::And(left_out(newest), hn::Set(tag, static_cast<std::uint16_t>(before)));
  return hn::And(hn::Or(look_up(word, newest), earlier),
                 hn::Set(tag, static_cast<std::uint16_t>(bits)));
}

// Words at whose time, `low`, the clock goes back; `before`: the time before the first.
HWY_INLINE std::uint32_t backward_times(WordVector low, std::uint32_t before) {
  alignas(16) static constexpr std::uint16_t kFirst[8] = {0xffff};
  const Words tag;
  const SignedWords whole;
  const auto first =
      hn::And(hn::Load(tag, kFirst), hn::Set(tag, static_cast<std::uint16_t>(before)));
  const auto low_before = hn::Or(hn::ShiftLeftLanes<1>(tag, low), first);
  return bits_of(
      hn::RebindMask(tag, hn::Gt(hn::BitCast(whole, low_before), hn::BitCast(whole, low))));
}

// Decodes the leading rows, columns, bases and low times among the next eight words. Returns false
// where the run ends, at an event outside the sensor or a time that goes back. The number of words
// depends on the types alone, so that the next iteration need not wait for the rest.
HWY_INLINE bool take_eight(Evt3Run& run) {
  const Words tag;
  const auto word = hn::LoadU(tag, reinterpret_cast<const std::uint16_t*>(run.next));
  const auto type = hn::ShiftRight<12>(word);
  const auto of_type = [&](Evt3Type wanted) HWY_ATTR {
    return bits_of(hn::Eq(type, hn::Set(tag, static_cast<std::uint16_t>(wanted))));
  };
  std::uint32_t rows = of_type(Evt3Type::kRow);
  std::uint32_t columns = of_type(Evt3Type::kColumn);
  std::uint32_t bases = of_type(Evt3Type::kVectorBase);
  std::uint32_t times = of_type(Evt3Type::kTimeLow);
  const int count = std::countr_one(rows | columns | bases | times);

  const auto coordinate = hn::Set(tag, static_cast<std::uint16_t>(Evt3Run::kCoordinate));
  const auto y = newest_of(word, kLookups.newest[rows], run.row, Evt3Run::kCoordinate);
  const auto low = newest_of(word, kLookups.newest[times], run.low_us, Evt3Run::kPayload);
  const auto x = hn::And(word, coordinate);
  const auto beyond = [](WordVector place, std::uint32_t size) HWY_ATTR {
    const SignedWords whole;
    return hn::Gt(hn::BitCast(whole, place), hn::Set(whole, static_cast<std::int16_t>(size - 1)));
  };
  const std::uint32_t outside =
      columns & ((1U << count) - 1) &
      bits_of(hn::RebindMask(tag, hn::Or(beyond(x, run.width), beyond(y, run.height))));
  const std::uint32_t back = backward_times(low, run.low_us) & ((1U << count) - 1);
  if (HWY_UNLIKELY((outside | back) != 0)) {
    while (run.take()) {
    }
    return false;
  }

  const std::uint32_t taken = (1U << count) - 1;
  rows &= taken;
  columns &= taken;
  bases &= taken;
  times &= taken;
  const auto polarity = hn::ShiftLeft<15 - Evt3Run::kFlagBit>(
      hn::And(word, hn::Set(tag, std::uint16_t{1U << Evt3Run::kFlagBit})));
  const Lookup& packed = kLookups.packed[columns];
  put_events(look_up(x, packed), look_up(hn::Or(y, polarity), packed), look_up(low, packed),
             static_cast<std::uint32_t>(run.offset_us), run.out);
  run.out += std::popcount(columns);
  keep_newest(run.next, rows, run.row);
  keep_newest(run.next, bases, run.base);
  keep_newest(run.next, times, run.low_us);
  run.low_us &= Evt3Run::kPayload;
  run.next += count * Evt3Run::kWordBytes;
  return true;
}

// The same, and then words of other types. Returns false where the run ends.
HWY_INLINE bool take_eight_and_others(Evt3Run& run) {
  if (!take_eight(run)) return false;
  while (run.next != run.end && run.out < run.full && !run.is_next_quiet()) {
    if (!run.take()) return false;
  }
  return true;
}
#endif

void take_words(Evt3Run& run) {
#if HWY_TARGET != HWY_SCALAR && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  Evt3Run local = run;
  constexpr std::ptrdiff_t kBytes = kWordsAtOnce * Evt3Run::kWordBytes;
  bool goes_on = true;
  // Near the longest offset each time is checked.
  const bool fits_any_time = local.offset_us + Evt3Run::kPayload <= Evt3Run::kLongestOffsetUs;
  while (goes_on && fits_any_time && local.end - local.next >= kBytes && local.out < local.full) {
    goes_on = take_eight_and_others(local);
  }
  run = local;
  if (!goes_on) return;
#endif
  while (run.next != run.end && run.out < run.full && run.take()) {
  }
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {

HWY_EXPORT(take_words);

void take_evt3_words(Evt3Run& run) { HWY_DYNAMIC_DISPATCH(take_words)(run); }

}  // namespace puck
#endif
