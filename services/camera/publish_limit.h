#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace puck {

/// Limits the mean publishing rate and the length of bursts, since LCM has no flow control.
class PublishLimit {
 public:
  using Clock = std::chrono::steady_clock;

  /// Delays by oversleeping are made up for within this time.
  static constexpr std::chrono::milliseconds kMostToMakeUp{1};

  /// Million events a second; 0: no limit.
  explicit PublishLimit(double mev_s) : mev_s_(mev_s) {}

  /// Earliest time of the next events.
  Clock::time_point due() const { return due_; }

  /// Counts events that are published now.
  void count(std::size_t events, Clock::time_point now) {
    if (mev_s_ <= 0) return;
    const auto cost_ns = static_cast<std::int64_t>(static_cast<double>(events) * 1e3 / mev_s_);
    due_ = std::max(due_, now - kMostToMakeUp) + std::chrono::nanoseconds(cost_ns);
  }

 private:
  double mev_s_;
  Clock::time_point due_{};
};

}  // namespace puck
