#include "common/vision/surface/region_filter.h"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/surface/region_filter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Copies from as many of the events as fill whole vectors. Returns the number of events examined
// and sets `copied` to the number of those inside. `region` lies within 15 bits and is not empty.
std::size_t copy_vectors(std::span<const Event> events, const Region& region, Event* out,
                         std::size_t& copied) {
  std::size_t done = 0;
  std::size_t count = 0;
  // An event is one lane of 64 bits and four of 16: x, y with the polarity on top, and two of time.
  const hn::ScalableTag<std::uint64_t> event_tag;
  const hn::Repartition<std::uint16_t, decltype(event_tag)> field_tag;
  const std::size_t lanes = hn::Lanes(event_tag);
  static_assert(hn::MaxLanes(event_tag) <= kCopySlack);
  const auto fields = [&](int x, int y) {
    const auto word = static_cast<std::uint64_t>(x) | static_cast<std::uint64_t>(y) << 16;
    return hn::BitCast(field_tag, hn::Set(event_tag, word));
  };
  const auto coordinates = fields(0xffff, 0x7fff);
  const auto origin = fields(region.x, region.y);
  const auto farthest = fields(region.width - 1, region.height - 1);
  for (; done + lanes <= events.size(); done += lanes) {
    const auto* from = reinterpret_cast<const std::uint64_t*>(events.data() + done);
    const auto event = hn::LoadU(event_tag, from);
    // Left of the region or above it the difference wraps and is large, so one comparison does.
    const auto from_origin = hn::Sub(hn::And(hn::BitCast(field_tag, event), coordinates), origin);
    const auto too_far = hn::BitCast(event_tag, hn::SaturatedSub(from_origin, farthest));
    const auto inside = hn::Eq(too_far, hn::Zero(event_tag));
#if HWY_TARGET <= HWY_AVX3
    auto* to = reinterpret_cast<std::uint64_t*>(out + count);
    count += hn::CompressStore(event, inside, event_tag, to);
#else
    // Without a compress instruction every event is stored, each over the last one outside.
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(event_tag, inside, bits);
    for (std::size_t i = 0; i < lanes; ++i) {
      out[count] = events[done + i];
      count += bits[0] >> i & 1U;
    }
#endif
  }
  copied = count;
  return done;
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {

HWY_EXPORT(copy_vectors);

std::size_t copy_inside(std::span<const Event> events, const Region& region, Event* out) {
  const Region known = region.intersect(Region::all_of({SensorSize::kMax, SensorSize::kMax}));
  if (known.empty()) return 0;
  std::size_t copied = 0;
  const std::size_t done = HWY_DYNAMIC_DISPATCH(copy_vectors)(events, known, out, copied);
  return copied + copy_inside_one_by_one(events.subspan(done), known, out + copied);
}

std::size_t copy_inside_one_by_one(std::span<const Event> events, const Region& region,
                                   Event* out) {
  Event* end = out;
  for (const Event& event : events) {
    if (region.contains(event.x, event.y)) *end++ = event;
  }
  return static_cast<std::size_t>(end - out);
}

bool any_inside(std::span<const Event> events, const Region& region) {
  bool any = false;
  for_inside(events, region, [&](std::span<const Event>) { any = true; });
  return any;
}

}  // namespace puck
#endif
