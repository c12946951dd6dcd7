#include "tools/info/rate_history.h"

#include <numeric>

#include <doctest/doctest.h>

namespace puck {
namespace {

TEST_CASE("bins of 10 µs are joined until the whole time fits") {
  RateHistory history;
  for (int i = 0; i < 100; ++i) history.add({1000 + i});
  CHECK(history.bin_us() == 10);
  CHECK(history.bins() == std::vector<std::int64_t>(10, 10));
  history.add({1000 + 40960});
  CHECK(history.bin_us() == 20);
  CHECK(history.bins().size() == 2049);
  CHECK(history.bins()[0] == 20);
  CHECK(std::accumulate(history.bins().begin(), history.bins().end(), std::int64_t{0}) == 101);
}

TEST_CASE("a pause of a century is no trouble") {
  RateHistory history;
  history.add({0});
  history.add({std::int64_t{3'155'760'000'000'000}});
  std::int64_t row_us = 0;
  const auto rows = history.coarse(20, row_us);
  CHECK(rows.size() <= 20);
  CHECK(rows.front() == 1);
  CHECK(rows.back() == 1);
  CHECK(std::accumulate(rows.begin(), rows.end(), std::int64_t{0}) == 2);
}

}  // namespace
}  // namespace puck
