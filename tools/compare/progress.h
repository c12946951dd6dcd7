#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace puck {

/// Prints a line for each finished step: number of steps done, its duration, and the remaining time
/// at this pace. Safe from any thread.
class Progress {
 public:
  /// `cost`: of all steps, in any unit.
  Progress(int steps, double cost);

  /// Counts a cached step, without a line and without effect on the pace.
  void skip(double cost);
  void finish(double cost, const std::string& what);

 private:
  std::mutex mutex_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  int steps_;
  int steps_done_ = 0;
  double cost_left_;
  double cost_done_ = 0;
};

}  // namespace puck
