#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace puck {

/// A line on a terminal's stderr that shows how far a long run is; nothing elsewhere. Removed on
/// destruction.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share`: of the work that is done, 0 to 1; nothing if unknown. Cheap.
  void show(std::int64_t events, std::optional<double> share);

 private:
  bool is_terminal_ = false;
  bool is_drawn_ = false;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace puck
