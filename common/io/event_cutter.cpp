#include "common/io/event_cutter.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

constexpr std::int64_t kLongestPause_us = std::int64_t{3600} * 1'000'000;

}  // namespace

std::optional<Timestamp> EventCutter::next_time() {
  if (used_ == packet_.events.size()) {
    used_ = 0;
    if (!events_.read(packet_, EventReader::kUsualEvents)) return std::nullopt;
  }
  const Timestamp next = packet_.time_of(packet_.events[used_]);
  if (before_ && next - *before_ > kLongestPause_us) {
    throw std::runtime_error("the recording pauses from " + std::to_string(before_->us) + " to " +
                             std::to_string(next.us) +
                             " µs, more than an hour: is a time damaged?");
  }
  before_ = next;
  return next;
}

void EventCutter::take_until(Timestamp until, EventPacket& piece) {
  const auto begin = packet_.events.begin() + static_cast<std::ptrdiff_t>(used_);
  const auto end = std::upper_bound(
      begin, packet_.events.end(), until,
      [&](Timestamp time, const Event& event) { return time < packet_.time_of(event); });
  piece.start = packet_.start;
  piece.events.assign(begin, end);
  used_ += piece.events.size();
}

}  // namespace puck
