#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace puck {

/// A line on a terminal's stderr that shows how far a long run is; nothing elsewhere. Removed on
/// destruction.
class ProgressBar {
 public:
  /// `unit`: of the amounts shown. `shown_per_count`: 1e-6 to show counts in millions.
  explicit ProgressBar(std::string unit, double shown_per_count = 1);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share`: of the work that is done, 0 to 1; nothing if unknown. Cheap.
  void show(std::int64_t count, std::optional<double> share);

 private:
  std::string unit_;
  double shown_per_count_;
  bool is_terminal_ = false;
  bool is_drawn_ = false;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace puck
