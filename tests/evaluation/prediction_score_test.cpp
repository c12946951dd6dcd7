#include "common/evaluation/prediction_score.h"

#include <optional>

#include <doctest/doctest.h>

namespace puck {
namespace {

Intercept crossing(double y_m, double in_s, int bounces = 0) {
  return {0.2325, y_m, in_s, 2, bounces, 0.01, 0.001};
}

TEST_CASE("Predictions are scored by their distance from the real crossing in place and time") {
  PredictionScore score;
  // A second's crossing at y = 0.1, predicted each 50 ms with an error that shrinks with the time
  // to go.
  for (int i = 0; i < 20; ++i) {
    const double to_go_s = 1.0 - 0.05 * i - 0.025;
    score.add({i * 50'000 + 25'000}, crossing(0.1 + 0.05 * to_go_s, to_go_s - 0.0015));
  }
  score.crossed({1'000'000}, 0.1);
  const PredictionReport report = score.report();
  CHECK(report.crossings == 1);
  for (std::size_t i = 0; i < PredictionReport::kBins; ++i) {
    CAPTURE(i);
    const PredictionBin& bin = report.direct[i];
    CHECK(bin.from_s == doctest::Approx(0.1 * static_cast<double>(i)));
    CHECK(bin.predictions == 2);
    // Two of them: to_go 0.025 and 0.075 into the bin. The median is the smaller one.
    CHECK(bin.median_m == doctest::Approx(0.05 * (bin.from_s + 0.025)));
    CHECK(bin.p90_m == doctest::Approx(0.05 * (bin.from_s + 0.075)));
    CHECK(bin.median_s == doctest::Approx(0.0015));
    CHECK(bin.time_within_1_sigma_percent == 0);
    CHECK(report.missing_percent[i] == 0);
    CHECK(report.bounced[i].predictions == 0);
  }
  CHECK(report.direct[0].within_1_sigma_percent == 100);
  CHECK(report.direct[1].within_1_sigma_percent == 100);
  CHECK(report.direct[2].within_1_sigma_percent == 0);
  CHECK(report.direct[3].within_2_sigma_percent == 100);
  CHECK(report.direct[4].within_2_sigma_percent == 0);
  CHECK(report.direct[0].time_within_2_sigma_percent == 100);
}

TEST_CASE(
    "Predictions with bounces are scored separately, moments without a prediction are missed") {
  PredictionScore score;
  score.add({0}, crossing(0, 0.35, 1));
  score.add({10'000}, std::nullopt);
  score.crossed({350'000}, 0.02);
  const PredictionReport report = score.report();
  CHECK(report.direct[3].predictions == 0);
  CHECK(report.bounced[3].predictions == 1);
  CHECK(report.bounced[3].median_m == doctest::Approx(0.02));
  CHECK(report.missing_percent[3] == 50);
}

TEST_CASE("A hit ends earlier predictions; crossings due before it were false") {
  PredictionScore score;
  score.add({0}, crossing(0, 0.5));
  score.add({300'000}, crossing(0, 0.5));
  score.add({400'000}, std::nullopt);
  score.interrupted({700'000});
  score.add({800'000}, crossing(0.3, 0.1));
  score.crossed({900'000}, 0.3);
  const PredictionReport report = score.report();
  CHECK(report.alarms == 3);
  CHECK(report.false_alarms == 1);
  CHECK(report.crossings == 1);
  std::int64_t scored = 0;
  for (const PredictionBin& bin : report.direct) scored += bin.predictions;
  CHECK(scored == 1);
}

TEST_CASE("Predictions more than a second ahead are not scored") {
  PredictionScore score;
  score.add({0}, crossing(0, 1.2));
  score.crossed({1'200'000}, 0);
  for (const PredictionBin& bin : score.report().direct) CHECK(bin.predictions == 0);
  CHECK(score.report().crossings == 1);
}

}  // namespace
}  // namespace puck
