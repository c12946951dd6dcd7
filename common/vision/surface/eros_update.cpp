#include "common/vision/surface/eros_update.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/surface/eros_update.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The half width is a template parameter so that loops are unrolled and divisions are cheap.
template <int kHalfWidth>
void apply(const ErosUpdateTarget& target, std::span<const Event> events) {
  // Vectors longer than a cache line would only cross more lines.
  const hn::CappedTag<std::uint8_t, 64> tag;
  constexpr std::size_t kLanes = hn::MaxLanes(tag);
  constexpr int kSide = 2 * kHalfWidth + 1;
  constexpr int kWidth = eros_strip_width(kHalfWidth);
  constexpr int kTouched = eros_strips_touched(kHalfWidth);
  constexpr std::size_t kRun = static_cast<std::size_t>(kSide * kWidth);
  constexpr std::size_t kMaskBytes = 64 * eros_mask_lines(kHalfWidth);

  std::uint8_t* const bytes = target.bytes;
  const std::size_t strip_bytes = target.strip_bytes;
  for (const Event& event : events) {
    const unsigned x = event.x;
    const unsigned y = event.y;
    const std::size_t phase = x % kWidth;
    // Algorithm 1, lines 2–6: decay the window. Runs end with whole vectors; the bytes beyond the
    // window lose nothing.
    std::uint8_t* run = bytes + x / kWidth * strip_bytes + y * kWidth;
    const std::uint8_t* mask = target.masks + phase * kTouched * kMaskBytes;
    for (int strip = 0; strip < kTouched; ++strip) {
      for (std::size_t i = 0; i < kRun; i += kLanes) {
        const auto pixels = hn::LoadU(tag, run + i);
        hn::StoreU(hn::SaturatedSub(pixels, hn::Load(tag, mask + i)), tag, run + i);
      }
      run += strip_bytes;
      mask += kMaskBytes;
    }
    // Algorithm 1, line 7: the event's own pixel.
    const unsigned column = x + kHalfWidth;
    bytes[column / kWidth * strip_bytes + (y + kHalfWidth) * kWidth + column % kWidth] = 255;
  }
}

void apply_with(const ErosUpdateTarget& target, std::span<const Event> events) {
  switch (target.half_width) {
    case 1:
      return apply<1>(target, events);
    case 2:
      return apply<2>(target, events);
    case 3:
      return apply<3>(target, events);
    case 4:
      return apply<4>(target, events);
    case 5:
      return apply<5>(target, events);
    case 6:
      return apply<6>(target, events);
    case 7:
      return apply<7>(target, events);
    default:
      return apply<8>(target, events);
  }
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {

HWY_EXPORT(apply_with);

void apply_eros_events(const ErosUpdateTarget& target, std::span<const Event> events) {
  HWY_DYNAMIC_DISPATCH(apply_with)(target, events);
}

}  // namespace puck
#endif
