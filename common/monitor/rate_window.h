#pragma once

#include <cstdint>
#include <deque>

namespace puck {

/// Monotonic counts.
struct Traffic {
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
  std::int64_t events = 0;
  std::int64_t troubles = 0;  ///< Lost, late, duplicate, malformed.
};

/// Rates of the counts over about the last `window_us` before the newest sample.
class RateWindow {
 public:
  /// The counts were 0 at `from_us`.
  RateWindow(std::int64_t window_us, std::int64_t from_us)
      : window_us_(window_us), samples_{{from_us, {}}} {}

  void add(std::int64_t now_us, const Traffic& sums) {
    samples_.push_back({now_us, sums});
    // Keeps the newest sample that is at least a window old.
    while (samples_.size() > 2 && now_us - samples_[1].time_us >= window_us_) samples_.pop_front();
  }

  /// 0 before any time has passed.
  double per_second(std::int64_t Traffic::*sum) const {
    const auto duration_us = samples_.back().time_us - samples_.front().time_us;
    if (duration_us <= 0) return 0;
    return static_cast<double>(increase(sum)) * 1e6 / static_cast<double>(duration_us);
  }
  std::int64_t increase(std::int64_t Traffic::*sum) const {
    return samples_.back().sums.*sum - samples_.front().sums.*sum;
  }

 private:
  struct Sample {
    std::int64_t time_us = 0;
    Traffic sums;
  };

  std::int64_t window_us_;
  std::deque<Sample> samples_;
};

}  // namespace puck
