#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace puck {

/// Keeps what is published below a mean rate, and bursts short: LCM tells no publisher that its
/// receivers cannot follow.
class PublishLimit {
 public:
  using Clock = std::chrono::steady_clock;

  /// What was missed, by waiting a little too long, is made up for within this.
  static constexpr std::chrono::milliseconds kMostToMakeUp{1};

  /// Million events a second; 0: no limit.
  explicit PublishLimit(double mev_s) : mev_s_(mev_s) {}

  /// When the next events may go.
  Clock::time_point due() const { return due_; }

  /// So many events go now.
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
