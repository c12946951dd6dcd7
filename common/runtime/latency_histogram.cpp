#include "common/runtime/latency_histogram.h"

#include <algorithm>
#include <bit>

namespace puck {

void LatencyHistogram::record(std::int64_t duration_us) {
  const std::int64_t duration = std::max<std::int64_t>(duration_us, 0);
  counts_[static_cast<std::size_t>(bucket_of(duration))].fetch_add(1, std::memory_order_relaxed);
  if (duration > max_us_.load(std::memory_order_relaxed)) {
    max_us_.store(duration, std::memory_order_relaxed);
  }
}

LatencySummary LatencyHistogram::summary() const {
  std::array<std::int64_t, kBuckets> counts;
  LatencySummary summary;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] = counts_[i].load(std::memory_order_relaxed);
    summary.samples += counts[i];
  }
  summary.max_us = max_us_.load(std::memory_order_relaxed);
  const auto percentile = [&](double fraction) {
    const double wanted = fraction * static_cast<double>(summary.samples);
    std::int64_t seen = 0;
    for (int i = 0; i < kBuckets; ++i) {
      seen += counts[static_cast<std::size_t>(i)];
      if (seen > 0 && static_cast<double>(seen) >= wanted) {
        return std::min(highest_in(i), summary.max_us);
      }
    }
    return summary.max_us;
  };
  summary.p50_us = percentile(0.50);
  summary.p99_us = percentile(0.99);
  return summary;
}

// The first 16 buckets are 1 µs wide; from there each doubling has 16 buckets.
int LatencyHistogram::bucket_of(std::int64_t duration_us) {
  if (duration_us < kSubBuckets) return static_cast<int>(duration_us);
  const int octave = std::bit_width(static_cast<std::uint64_t>(duration_us)) - 4;
  if (octave >= kOctaves) return kBuckets - 1;
  const auto sub = static_cast<int>((duration_us >> (octave - 1)) - kSubBuckets);
  return octave * kSubBuckets + sub;
}

std::int64_t LatencyHistogram::highest_in(int bucket) {
  if (bucket < kSubBuckets) return bucket;
  const int octave = bucket / kSubBuckets;
  const std::int64_t sub = bucket % kSubBuckets;
  return ((kSubBuckets + sub + 1) << (octave - 1)) - 1;
}

}  // namespace puck
