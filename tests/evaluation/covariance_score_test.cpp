#include "common/evaluation/covariance_score.h"

#include <cmath>
#include <limits>
#include <random>

#include <doctest/doctest.h>

#include "common/evaluation/accuracy_score.h"

namespace puck {
namespace {

// At (10 + dx, 20 + dy), with this covariance of the position.
PuckEstimate estimate(double dx, double dy, double xx, double xy, double yy) {
  PuckEstimate estimate;
  estimate.state = TrackState::kTracking;
  estimate.position = Pixel{10 + dx, 20 + dy};
  estimate.covariance[0] = xx;
  estimate.covariance[1] = estimate.covariance[4] = xy;
  estimate.covariance[5] = yy;
  return estimate;
}

constexpr Pixel kTruth{10, 20};

}  // namespace

TEST_CASE("an error is measured in the covariance's own ellipse") {
  CHECK(*normalised_error_squared(estimate(3, 0, 9, 0, 1), kTruth) == doctest::Approx(1));
  CHECK(*normalised_error_squared(estimate(0, 3, 9, 0, 1), kTruth) == doctest::Approx(9));
  // P = [2 1; 1 2], P^-1 = [2 -1; -1 2] / 3: along the long axis, and across it.
  CHECK(*normalised_error_squared(estimate(1, 1, 2, 1, 2), kTruth) == doctest::Approx(2.0 / 3));
  CHECK(*normalised_error_squared(estimate(1, -1, 2, 1, 2), kTruth) == doctest::Approx(2));
}

TEST_CASE("without a covariance, a position or a track there is no normalised error") {
  CHECK_FALSE(normalised_error_squared(estimate(1, 1, 0, 0, 0), kTruth).has_value());
  PuckEstimate no_position = estimate(0, 0, 1, 0, 1);
  no_position.position.reset();
  CHECK_FALSE(normalised_error_squared(no_position, kTruth).has_value());
  PuckEstimate lost = estimate(0, 0, 1, 0, 1);
  lost.state = TrackState::kLost;
  CHECK_FALSE(normalised_error_squared(lost, kTruth).has_value());
  CHECK_FALSE(covariance_report({}).has_value());
}

TEST_CASE("an invalid covariance is never within its bound") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isinf(*normalised_error_squared(estimate(0, 0, 1, 1, 1), kTruth)));
  CHECK(std::isinf(*normalised_error_squared(estimate(0, 0, -1, 0, -1), kTruth)));
  CHECK(std::isinf(*normalised_error_squared(estimate(0, 0, nan, 0, 1), kTruth)));
  const auto report = covariance_report({2, std::numeric_limits<double>::infinity()});
  CHECK(report->estimates == 2);
  CHECK(report->nees_mean == 2);
  CHECK(report->nees_within_95_percent == 50);
}

TEST_CASE("mean, median and share within the bound of chi squared are those of the values") {
  const auto report = covariance_report({7, 1, 3, 5});
  CHECK(report->nees_mean == 4);
  CHECK(report->nees_median == 3);
  CHECK(report->nees_within_95_percent == 75);
}

TEST_CASE("errors drawn from the covariance itself are consistent with it") {
  // Fixed draws; correlated by the Cholesky factor of P = [4 1.2; 1.2 1].
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (int i = 0; i < 20'000; ++i) {
    const double a = normal(random);
    const double b = normal(random);
    const PuckEstimate drawn = estimate(2 * a, 0.6 * a + 0.8 * b, 4, 1.2, 1);
    values.push_back(*normalised_error_squared(drawn, kTruth));
  }
  const auto report = covariance_report(values);
  CHECK(report->nees_mean == doctest::Approx(2).epsilon(0.03));
  CHECK(report->nees_median == doctest::Approx(1.386).epsilon(0.03));
  CHECK(report->nees_within_95_percent == doctest::Approx(95).epsilon(0.01));
}

TEST_CASE("the ticks that count determine the covariance's figures") {
  std::vector<TruthRow> rows;
  for (int ms = 0; ms <= 1000; ++ms) rows.push_back({{ms * 1000}, {10.0 + ms, 20}, {30, 20}, 1});
  AccuracyScore score(TruthTrack(rows), {640, 480});
  for (int ms = 500; ms < 600; ++ms) {
    // The error is 2 px, which is twice the standard deviation of the first half.
    const double variance = ms < 550 ? 1 : 4;
    score.add({ms * 1000}, estimate(ms + 2, 0, variance, 0, variance));
  }
  const auto report = score.report().covariance;
  CHECK(report->estimates == 100);
  CHECK(report->nees_mean == doctest::Approx(2.5));
  CHECK(report->nees_within_95_percent == 100);
}

}  // namespace puck
