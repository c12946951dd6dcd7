#include "common/runtime/latency_histogram.h"

#include <cstdint>
#include <limits>

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("an empty histogram has no samples and no latency") {
  const LatencySummary summary = LatencyHistogram{}.summary();
  CHECK(summary.samples == 0);
  CHECK(summary.p50_us == 0);
  CHECK(summary.max_us == 0);
}

TEST_CASE("percentiles are at most a sixteenth too high and never too low") {
  LatencyHistogram histogram;
  for (int i = 1; i <= 10'000; ++i) histogram.record(i);
  const LatencySummary summary = histogram.summary();
  CHECK(summary.samples == 10'000);
  CHECK(summary.max_us == 10'000);
  CHECK(summary.p50_us >= 5'000);
  CHECK(summary.p50_us <= 5'000 * 17 / 16);
  CHECK(summary.p99_us >= 9'900);
  CHECK(summary.p99_us <= 10'000);
}

TEST_CASE("durations up to an hour are read at most a sixteenth too high, and never too low") {
  constexpr std::int64_t kHourUs = 3'600'000'000;
  for (std::int64_t duration_us = 1; duration_us < kHourUs; duration_us += 1 + duration_us / 50) {
    LatencyHistogram histogram;
    histogram.record(duration_us);
    histogram.record(duration_us);
    // A longer one, because the longest is exact and would hide its bucket.
    histogram.record(kHourUs * 2);
    REQUIRE(histogram.summary().p50_us >= duration_us);
    REQUIRE(histogram.summary().p50_us * 16 <= duration_us * 17);
  }
}

TEST_CASE("short durations are exact") {
  LatencyHistogram histogram;
  for (int i = 0; i < 99; ++i) histogram.record(7);
  histogram.record(15);
  CHECK(histogram.summary().p50_us == 7);
  CHECK(histogram.summary().p99_us == 7);
  CHECK(histogram.summary().max_us == 15);
}

TEST_CASE("one long duration changes the maximum alone") {
  LatencyHistogram histogram;
  for (int i = 0; i < 1000; ++i) histogram.record(20);
  histogram.record(1'000'000);
  CHECK(histogram.summary().p99_us <= 21);
  CHECK(histogram.summary().max_us == 1'000'000);
}

TEST_CASE("impossible durations are counted at the ends of the range") {
  LatencyHistogram histogram;
  histogram.record(-5);
  CHECK(histogram.summary().p50_us == 0);
  histogram.record(std::numeric_limits<std::int64_t>::max());
  CHECK(histogram.summary().samples == 2);
  CHECK(histogram.summary().max_us == std::numeric_limits<std::int64_t>::max());
}

}  // namespace puck
