#pragma once

#include <algorithm>
#include <chrono>

namespace puck {

/// Delays before further attempts: each twice as long as the one before, up to 5 s.
class RetryPause {
 public:
  explicit RetryPause(std::chrono::milliseconds first) : first_(first), next_(first) {}

  std::chrono::milliseconds take() {
    const auto pause = next_;
    next_ = std::min(2 * next_, kLongest);
    return pause;
  }

  /// After a success.
  void restart() { next_ = first_; }

 private:
  static constexpr std::chrono::milliseconds kLongest{5000};

  std::chrono::milliseconds first_;
  std::chrono::milliseconds next_;
};

}  // namespace puck
