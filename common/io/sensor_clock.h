#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/io/event_sink.h"

namespace puck {

/// The time of Prophesee word streams: a high part in time words, which wraps, and a low part with
/// the events.
///
/// A time word that continues the clock (the same value, or up to `usual_steps` more) is accepted
/// at once. Any other may be a pause, a wrap or a flipped bit, so the events after it are held back
/// until the next time word. If that one continues the earlier clock rather than the doubtful word,
/// the doubtful word was a glitch. Devices repeat time words every few µs, so the wait is short.
class SensorClock {
 public:
  SensorClock(int high_bits, int low_bits, std::int64_t usual_steps = 1)
      : high_count_(std::int64_t{1} << high_bits), low_bits_(low_bits), usual_steps_(usual_steps) {}

  bool is_known() const { return is_known_; }

  /// Whether events can be timed at once.
  bool is_steady() const { return is_known_ && !is_doubtful_; }

  /// The time `low_us` after the newest time word; only while is_steady().
  Timestamp time_of(std::uint32_t low_us) const { return time_of(high_, low_us); }

  /// Processes a time word. Returns whether it differs from the previous one.
  bool set_high(std::uint32_t raw, EventSink& sink);

  /// Adds an event `low_us` after the newest time word. The clock must be known.
  void append(std::uint32_t low_us, int x, int y, bool brighter, EventSink& sink) {
    if (is_doubtful_) {
      hold_back({low_us, x, y, brighter}, sink);
    } else {
      sink.append(time_of(high_, low_us), x, y, brighter);
    }
  }

  /// Number of steps by which `raw` lies behind the clock; `std::nullopt` if it is not at most
  /// `most`. Only while is_steady().
  std::optional<std::int64_t> steps_behind(std::uint32_t raw, std::int64_t most) const {
    const std::int64_t steps = (high_ - static_cast<std::int64_t>(raw)) & (high_count_ - 1);
    if (steps == 0 || steps > most) return std::nullopt;
    return steps;
  }

  /// Goes on by `steps`, for a decoder that has checked the time words itself. Only while
  /// is_steady().
  void advance(std::int64_t steps) {
    high_ += steps;
    newest_raw_ = raw();
  }
  /// The time word that stands for the present time.
  std::uint32_t raw() const { return static_cast<std::uint32_t>(high_ & (high_count_ - 1)); }

  /// Ends the stream: accepts the newest time word.
  void finish(EventSink& sink);

 private:
  struct HeldEvent {
    std::uint32_t low_us = 0;
    int x = 0;
    int y = 0;
    bool brighter = false;
  };

  Timestamp time_of(std::int64_t high, std::uint32_t low_us) const {
    return {(high << low_bits_) | low_us};
  }
  std::int64_t steps_to(std::uint32_t raw, std::int64_t from) const;
  std::int64_t unwrapped(std::uint32_t raw) const;
  void hold_back(const HeldEvent& event, EventSink& sink);
  void settle(std::int64_t high, EventSink& sink);

  std::int64_t high_count_;
  int low_bits_;
  std::int64_t usual_steps_;
  bool is_known_ = false;
  bool is_doubtful_ = false;
  std::int64_t high_ = 0;         // Unwrapped.
  std::uint32_t newest_raw_ = 0;  // The newest time word, accepted or not.
  std::vector<HeldEvent> held_;
};

}  // namespace puck
