#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "common/events/event.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// Copies the events inside `region`, in order, to `out`, which has room for all of them and
/// kCopySlack more; returns their number. Uses the machine's widest vectors and no branch for each
/// event: the branches would be unpredictable, and mispredictions would cost more than the rest of
/// the work.
inline constexpr std::size_t kCopySlack = 8;
std::size_t copy_inside(std::span<const Event> events, const Region& region, Event* out);
/// The specification of copy_inside(), event by event.
std::size_t copy_inside_one_by_one(std::span<const Event> events, const Region& region, Event* out);

/// Calls `use(std::span<const Event>)` with the events inside `region`, in order, in pieces of a
/// few hundred, never with an empty one.
template <typename Use>
void for_inside(std::span<const Event> events, const Region& region, Use&& use) {
  constexpr std::size_t kAtOnce = 512;
  // Raw bytes, because an array of events would be cleared each time.
  alignas(Event) std::array<std::byte, (kAtOnce + kCopySlack) * sizeof(Event)> room;
  auto* const inside = reinterpret_cast<Event*>(room.data());
  while (!events.empty()) {
    const std::span<const Event> part = events.first(std::min(events.size(), kAtOnce));
    const std::size_t count = copy_inside(part, region, inside);
    if (count > 0) use(std::span<const Event>(inside, count));
    events = events.subspan(part.size());
  }
}

/// Whether any event lies inside `region`.
bool any_inside(std::span<const Event> events, const Region& region);

}  // namespace puck
