#include "common/vision/correlation/weighted_peak.h"

#include <random>

#include <doctest/doctest.h>

namespace puck {
namespace {

// As the authors' code does it: everything weighted, rounded to 256 levels, the first maximum.
WeightedPeak find_plainly(const WeightedWindow& window, double lowest) {
  const int width = window.response.width();
  std::vector<double> values;
  for (int y = 0; y < window.response.height(); ++y) {
    for (int x = 0; x < width; ++x) {
      values.push_back(std::max(0.0, window.response(x, y) - lowest) *
                       (*window.rows)[static_cast<std::size_t>(y)] *
                       (*window.columns)[static_cast<std::size_t>(x)]);
    }
  }
  if (window.quantised) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double least = *low;
    const double scale = *high > least ? 255 / (*high - least) : 0;
    for (double& value : values) value = std::nearbyint((value - least) * scale);
  }
  const auto best = std::max_element(values.begin(), values.end());
  if (!(*best > 0)) return {};
  const auto index = static_cast<int>(best - values.begin());
  return {index % width, index / width, true};
}

}  // namespace

TEST_CASE("a peak is the first maximum of the weighted response; known bounds find the same one") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> grey(-1000, 3000);
  int settled = 0;
  GaussianTable column_table;
  GaussianTable row_table;
  WeightedPeakFinder finder;
  for (int round = 0; round < 2000; ++round) {
    const int width = 3 + round % 40;
    const int height = 2 + round % 31;
    Image<double> response(width, height);
    const double scale = 1 + round % 7;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) response(x, y) = std::round(grey(random) / scale);
    }
    const auto& columns = column_table.at(-width / 2.0, width, width / 2.0);
    const auto& rows = row_table.at(-height / 2.0, height, height / 2.0);
    const WeightedWindow window{response.view(), &columns, &rows, round % 2 == 0};
    const double lowest = -1500 / scale;
    const WeightedPeak expected = find_plainly(window, lowest);
    const WeightedPeak found = finder.find(window, lowest);
    REQUIRE(found.x == expected.x);
    REQUIRE(found.y == expected.y);
    REQUIRE(found.stands_out == expected.stands_out);
    const auto between = finder.find_between(window, -3000 / scale, -1000 / scale);
    if (!between) continue;
    ++settled;
    REQUIRE(between->x == expected.x);
    REQUIRE(between->y == expected.y);
  }
  CHECK(settled > 500);
  CHECK(settled < 2000);
}

TEST_CASE("an even response has no peak that stands out") {
  Image<double> response(5, 5);
  std::fill_n(response.row(0), 25, 7.0);
  const std::vector<double> ones(5, 1.0);
  WeightedPeakFinder finder;
  CHECK_FALSE(finder.find({response.view(), &ones, &ones, true}, 7).stands_out);
  CHECK_FALSE(finder.find({response.view(), &ones, &ones, false}, 7).stands_out);
  CHECK_FALSE(finder.find_between({response.view(), &ones, &ones, false}, -10, 7).has_value());
}

}  // namespace puck
