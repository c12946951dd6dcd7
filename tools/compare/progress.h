#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace puck {

/// Tells each finished step on a line: how many are done, how long it took, how long the rest will
/// take at this pace. Safe from any thread.
class Progress {
 public:
  /// `cost` in units of one's own choice, of all `steps` together.
  Progress(int steps, double cost);

  /// `cached`: it took no time and says nothing about the pace. Not told, only counted.
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
