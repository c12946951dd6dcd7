#include "tools/view/live/latency_window.h"

#include <algorithm>
#include <vector>

namespace puck {
namespace {

constexpr std::int64_t kWindow_us = 1'000'000;
// A tracker publishes up to 5000 estimates a second.
constexpr std::size_t kMostValues = 20'000;

std::int64_t percentile(std::vector<std::int64_t>& values, std::size_t percent) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * percent / 100);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

void LatencyWindow::add(std::int64_t latency_us, std::int64_t now_us) {
  values_.emplace_back(now_us, latency_us);
  while (values_.size() > kMostValues || now_us - values_.front().first > kWindow_us) {
    values_.pop_front();
  }
}

ViewLatency LatencyWindow::percentiles(std::int64_t now_us) const {
  ViewLatency latency{.name = name_};
  std::vector<std::int64_t> values;
  for (const auto& [time_us, value] : values_) {
    if (now_us - time_us <= kWindow_us) values.push_back(value);
  }
  if (values.empty()) return latency;
  latency.p50_us = percentile(values, 50);
  latency.p99_us = percentile(values, 99);
  latency.max_us = *std::max_element(values.begin(), values.end());
  return latency;
}

}  // namespace puck
