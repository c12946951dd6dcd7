#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace puck {

struct LatencySummary {
  std::int64_t p50_us = 0;
  std::int64_t p99_us = 0;
  std::int64_t max_us = 0;
  std::int64_t samples = 0;
};

/// Histogram of durations in fixed memory, from 1 µs to more than an hour. The buckets widen with
/// the duration, so that a percentile is at most 1/16 too high. One thread records, any thread
/// summarises; a summary made during a recording may miss that one.
class LatencyHistogram {
 public:
  /// Recording thread only. Negative durations count as 0; the range's end limits long ones.
  void record(std::int64_t duration_us);

  /// Safe from any thread. Percentiles are the upper ends of their buckets, but never above the
  /// longest duration recorded.
  LatencySummary summary() const;

 private:
  // Relaxed order suffices: the counters are independent.
  static constexpr int kSubBuckets = 16;
  static constexpr int kOctaves = 30;
  static constexpr int kBuckets = kSubBuckets * kOctaves;

  static int bucket_of(std::int64_t duration_us);
  static std::int64_t highest_in(int bucket);

  std::array<std::atomic<std::int64_t>, kBuckets> counts_{};
  std::atomic<std::int64_t> max_us_{0};
};

}  // namespace puck
