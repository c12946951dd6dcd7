#include "common/io/sorted_events.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

// The rest of the file, up to the namespace's end, is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/io/sorted_events.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

bool are_events_sorted(std::span<const Event> events) {
  std::size_t checked = 0;  // Each with the one after it.
#if HWY_TARGET != HWY_SCALAR && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  // An event as a number has its offset in the upper half.
  const hn::ScalableTag<std::int64_t> tag;
  constexpr std::size_t kVectorsAtOnce = 4;
  const std::size_t lanes = hn::Lanes(tag);
  const auto offsets_from = [&](std::size_t first) HWY_ATTR {
    const auto* const words = reinterpret_cast<const std::uint64_t*>(events.data() + first);
    const hn::RebindToUnsigned<decltype(tag)> plain;
    return hn::BitCast(tag, hn::ShiftRight<32>(hn::LoadU(plain, words)));
  };
  while (checked + kVectorsAtOnce * lanes < events.size()) {
    auto is_back = hn::Gt(offsets_from(checked), offsets_from(checked + 1));
    for (std::size_t i = 1; i < kVectorsAtOnce; ++i) {
      const std::size_t first = checked + i * lanes;
      is_back = hn::Or(is_back, hn::Gt(offsets_from(first), offsets_from(first + 1)));
    }
    if (!hn::AllFalse(tag, is_back)) return false;
    checked += kVectorsAtOnce * lanes;
  }
#endif
  return std::is_sorted(events.begin() + static_cast<std::ptrdiff_t>(checked), events.end(),
                        [](const Event& a, const Event& b) { return a.offset_us < b.offset_us; });
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {

HWY_EXPORT(are_events_sorted);

bool are_sorted(std::span<const Event> events) {
  return HWY_DYNAMIC_DISPATCH(are_events_sorted)(events);
}

}  // namespace puck
#endif
