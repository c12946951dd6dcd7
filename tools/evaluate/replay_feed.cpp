#include "tools/evaluate/replay_feed.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace puck {
namespace {

constexpr std::size_t kWholePacket = std::numeric_limits<std::size_t>::max();

// Number of events from index `from` on up to `time`.
std::int64_t count_not_after(const EventPacket& packet, std::size_t from, Timestamp time) {
  const auto begin = packet.events.begin() + static_cast<std::ptrdiff_t>(from);
  const auto end =
      std::upper_bound(begin, packet.events.end(), time,
                       [&](Timestamp t, const Event& event) { return t < packet.time_of(event); });
  return end - begin;
}

}  // namespace

bool ReplayFeed::skip_to_start(std::int64_t applied, Timestamp time) {
  const std::optional<std::int64_t> start = find_start(applied, time);
  events_.rewind();
  std::int64_t skipped = 0;
  while (start && skipped < *start && events_.read(packet_, kWholePacket)) {
    skipped += static_cast<std::int64_t>(packet_.events.size());
  }
  packet_.events.clear();
  used_ = 0;
  return start.has_value();
}

// Events before the first packet for which the count fits the time.
std::optional<std::int64_t> ReplayFeed::find_start(std::int64_t applied, Timestamp time) {
  std::vector<std::int64_t> starts;
  std::int64_t before = 0;
  EventPacket packet;
  while (events_.read(packet, kWholePacket)) {
    starts.push_back(before);
    const std::int64_t after = before + static_cast<std::int64_t>(packet.events.size());
    // Most estimates are made between two packets …
    if (packet.newest() == time) {
      const auto whole = std::find(starts.begin(), starts.end(), after - applied);
      if (whole != starts.end()) return *whole;
    }
    // … others after one of the events with that time.
    const std::int64_t first = before + count_not_after(packet, 0, time - 1);
    const std::int64_t last = before + count_not_after(packet, 0, time);
    const auto inside = std::find_if(starts.begin(), starts.end(), [&](std::int64_t start) {
      return start + applied > first && start + applied <= last;
    });
    if (inside != starts.end()) return *inside;
    if (packet.newest() > time) break;
    before = after;
  }
  return std::nullopt;
}

bool ReplayFeed::feed(std::int64_t applied, Timestamp time) {
  while (has_more()) {
    const std::int64_t wanted = applied - ahead_ - summary_.events;
    const std::int64_t count = std::min(count_not_after(packet_, used_, time), wanted);
    if (count <= 0) break;
    give(static_cast<std::size_t>(count));
  }
  if (summary_.events + ahead_ == applied && summary_.last == time) return true;
  while (has_more()) {
    const std::int64_t count = count_not_after(packet_, used_, time);
    if (count == 0) break;
    give(static_cast<std::size_t>(count));
  }
  ahead_ = applied - summary_.events;
  return false;
}

bool ReplayFeed::has_more() {
  if (used_ < packet_.events.size()) return true;
  used_ = 0;
  return events_.read(packet_, kWholePacket);
}

void ReplayFeed::give(std::size_t count) {
  const auto begin = packet_.events.begin() + static_cast<std::ptrdiff_t>(used_);
  piece_.start = packet_.start;
  piece_.events.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  used_ += count;
  tracker_.update(piece_);
  if (summary_.events == 0) summary_.first = piece_.time_of(piece_.events.front());
  summary_.events += static_cast<std::int64_t>(count);
  summary_.last = piece_.newest();
  summary_.duration_s = static_cast<double>(summary_.last - summary_.first) * 1e-6;
}

}  // namespace puck
