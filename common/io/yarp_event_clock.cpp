#include "common/io/yarp_event_clock.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr std::int64_t kWrap = std::int64_t{1} << 31;
// The host's clock is the packet's sending time, which is late by less than this.
constexpr double kSlackUs = 1e6;
// This many doubtful events in a row are not damage: the counter was reset.
constexpr int kMostDoubtful = 64;

// Signed difference of two stamps, the shorter way round.
std::int64_t ticks_between(std::uint32_t from, std::uint32_t to) {
  const std::int64_t forward = (std::int64_t{to} - std::int64_t{from}) & (kWrap - 1);
  return forward < kWrap / 2 ? forward : forward - kWrap;
}

}  // namespace

std::optional<Timestamp> YarpEventClock::at(std::uint32_t stamp, double host_s) {
  if (!is_known_) {
    is_known_ = true;
    stamp_ = stamp;
    host_s_ = host_s;
  }
  const double waited_us = std::max(host_s - host_s_, 0.0) * 1e6;
  const double waited_ticks = waited_us / us_per_tick_;
  std::int64_t step = ticks_between(stamp_, stamp);
  const double wraps = (waited_ticks - static_cast<double>(step)) / static_cast<double>(kWrap);
  step += kWrap * std::max<std::int64_t>(std::llround(wraps), 0);
  const double step_us = static_cast<double>(step) * us_per_tick_;
  if (step_us > waited_us + kSlackUs || step_us < -kSlackUs) {
    if (++doubtful_in_succession_ < kMostDoubtful) return std::nullopt;
    step = std::llround(waited_ticks);
  }
  doubtful_in_succession_ = 0;
  const std::int64_t ticks = ticks_ + step;
  if (step >= 0) {
    ticks_ = ticks;
    stamp_ = stamp;
    host_s_ = host_s;
  }
  return Timestamp{std::llround(static_cast<double>(ticks) * us_per_tick_)};
}

}  // namespace puck
