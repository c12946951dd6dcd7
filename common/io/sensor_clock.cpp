#include "common/io/sensor_clock.h"

namespace puck {
namespace {

// After this many events without a time word, the doubtful one is accepted.
constexpr std::size_t kMostHeldEvents = 65536;

}  // namespace

bool SensorClock::set_high(std::uint32_t raw, EventSink& sink) {
  if (!is_known_) {
    is_known_ = true;
    high_ = raw;
    newest_raw_ = raw;
    return true;
  }
  if (is_doubtful_) {
    if (steps_to(raw, high_) < steps_to(raw, newest_raw_)) {
      ++sink.counters().time_glitches;
      settle(high_, sink);
    } else {
      settle(unwrapped(newest_raw_), sink);
    }
  }
  const bool changed = raw != newest_raw_;
  newest_raw_ = raw;
  const std::int64_t steps = steps_to(raw, high_);
  if (steps <= usual_steps_) {
    high_ += steps;
  } else {
    is_doubtful_ = true;
  }
  return changed;
}

void SensorClock::finish(EventSink& sink) {
  if (is_doubtful_) settle(unwrapped(newest_raw_), sink);
  sink.counters().time_wraps = high_ / high_count_;
}

std::int64_t SensorClock::steps_to(std::uint32_t raw, std::int64_t from) const {
  return (static_cast<std::int64_t>(raw) - from) & (high_count_ - 1);
}

std::int64_t SensorClock::unwrapped(std::uint32_t raw) const {
  const std::int64_t old_raw = high_ & (high_count_ - 1);
  const std::int64_t candidate = high_ - old_raw + raw;
  // Half the range back or more is a wrap; less is a clock that was set back.
  return old_raw - static_cast<std::int64_t>(raw) >= high_count_ / 2 ? candidate + high_count_
                                                                     : candidate;
}

void SensorClock::hold_back(const HeldEvent& event, EventSink& sink) {
  held_.push_back(event);
  if (held_.size() >= kMostHeldEvents) settle(unwrapped(newest_raw_), sink);
}

void SensorClock::settle(std::int64_t high, EventSink& sink) {
  high_ = high;
  is_doubtful_ = false;
  for (const HeldEvent& event : held_) {
    sink.append(time_of(high_, event.low_us), event.x, event.y, event.brighter);
  }
  held_.clear();
}

}  // namespace puck
