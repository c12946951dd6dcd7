#include "common/io/cd_word_run.h"

#include <algorithm>
#include <bit>

#include "common/events/event_bits.h"
#include "common/io/word_assembler.h"

// The rest of the file, up to the namespace's end, is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/io/cd_word_run.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PUCK_COMMON_IO_CD_WORD_RUN_ONCE
#define PUCK_COMMON_IO_CD_WORD_RUN_ONCE
namespace puck {

inline bool CdWordRun::take() {
  const auto word = load_word<std::uint32_t>(next);
  if (type_of(word) == time_type) {
    const std::uint32_t step = ((word & kHigh) - high) & kHigh;
    constexpr std::int64_t kStepUs = kLowUs + 1;
    if (step > 1 || offset_us + 2 * kStepUs > kLongestOffsetUs) return false;
    if (step == 1) {
      high = word & kHigh;
      ++steps;
      offset_us += kStepUs;
      low_us = 0;
    }
  } else {
    const std::uint32_t polarity = type_of(word) - darker;
    const std::uint32_t x = x_of(word);
    const std::uint32_t y = y_of(word);
    if (polarity > 1 || x >= width || y >= height || low_us_of(word) < low_us) return false;
    low_us = low_us_of(word);
    *out++ = std::bit_cast<Event>(
        event_bits(x, y, polarity, static_cast<std::uint32_t>(offset_us + low_us)));
  }
  next += kWordBytes;
  return true;
}

}  // namespace puck
#endif

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
using Words = hn::CappedTag<std::uint32_t, 16>;

template <typename Mask>
HWY_INLINE std::uint32_t bits_of(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Words(), mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

HWY_INLINE hn::Vec<Words> load(const std::byte* bytes) {
  return hn::LoadU(Words(), reinterpret_cast<const std::uint32_t*>(bytes));
}

// Decodes the leading events of the next words, of which there must be one more than lanes, with
// as much space. Returns their number.
HWY_INLINE int take_block(CdWordRun& run) {
  const Words tag;
  const hn::RebindToSigned<Words> whole;
  const auto number = [&](std::uint32_t value) HWY_ATTR { return hn::Set(tag, value); };
  // All values have less than 31 bits.
  const auto above = [&](hn::Vec<Words> value, std::uint32_t most) HWY_ATTR {
    return hn::Gt(hn::BitCast(whole, value), hn::Set(whole, static_cast<std::int32_t>(most)));
  };
  const auto low_us = [&](hn::Vec<Words> words) HWY_ATTR {
    return hn::And(hn::ShiftRight<22>(words), number(CdWordRun::kLowUs));
  };
  const auto word = load(run.next);
  const auto polarity = hn::Sub(hn::ShiftRight<28>(word), number(run.darker));
  const auto x = hn::And(hn::ShiftRight<11>(word), number(CdWordRun::kCoordinate));
  const auto y = hn::And(word, number(CdWordRun::kCoordinate));
  const auto low = low_us(word);
  const auto low_after = low_us(load(run.next + CdWordRun::kWordBytes));

  // A type before `darker` becomes negative, which has other bits than the lowest, too.
  const auto is_event = hn::Eq(hn::AndNot(number(1), polarity), hn::Zero(tag));
  const std::uint32_t outside =
      bits_of(hn::RebindMask(tag, hn::Or(above(x, run.width - 1), above(y, run.height - 1))));
  const std::uint32_t back_after =
      bits_of(hn::RebindMask(tag, hn::Gt(hn::BitCast(whole, low), hn::BitCast(whole, low_after))));
  const bool is_first_back = CdWordRun::low_us_of(load_word<std::uint32_t>(run.next)) < run.low_us;
  const std::uint32_t unusual = outside | back_after << 1 | (is_first_back ? 1U : 0U);
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const int count = std::min(lanes, std::countr_one(bits_of(is_event) & ~unusual));
  if (count == 0) return 0;

  const auto places = hn::Or(hn::Or(x, hn::ShiftLeft<16>(y)), hn::ShiftLeft<31>(polarity));
  const auto offset = hn::Add(low, number(static_cast<std::uint32_t>(run.offset_us)));
  hn::StoreInterleaved2(places, offset, tag, reinterpret_cast<std::uint32_t*>(run.out));
  run.out += count;
  run.next += count * CdWordRun::kWordBytes;
  run.low_us = CdWordRun::low_us_of(load_word<std::uint32_t>(run.next - CdWordRun::kWordBytes));
  return count;
}
#endif

void take_words(CdWordRun& run) {
#if HWY_TARGET != HWY_SCALAR && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  CdWordRun local = run;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(Words()));
  bool goes_on = true;
  while (goes_on && local.end - local.next > lanes * CdWordRun::kWordBytes &&
         local.full - local.out >= lanes) {
    if (take_block(local) < lanes) goes_on = local.take();
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

void take_cd_words(CdWordRun& run) { HWY_DYNAMIC_DISPATCH(take_words)(run); }

}  // namespace puck
#endif
