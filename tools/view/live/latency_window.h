#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <utility>

#include "tools/view/interface/view_state.h"

namespace puck {

/// Latencies of the last second. One thread.
class LatencyWindow {
 public:
  explicit LatencyWindow(std::string name) : name_(std::move(name)) {}

  void add(std::int64_t latency_us, std::int64_t now_us);

  /// Without values if there was none in the second before.
  ViewLatency percentiles(std::int64_t now_us) const;

 private:
  std::string name_;
  std::deque<std::pair<std::int64_t, std::int64_t>> values_;  // Time, latency.
};

}  // namespace puck
