#include "common/evaluation/accuracy_score.h"

#include <optional>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "common/evaluation/paper_score.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};

// A puck that moves 1 px a millisecond to the right for two seconds, with a row every 10 ms.
TruthTrack moving_truth() {
  std::vector<TruthRow> rows;
  for (int i = 0; i <= 200; ++i) {
    rows.push_back({{i * 10'000}, {10.0 + i, 100}, {30, 20}, 1});
  }
  return TruthTrack(rows);
}

PuckEstimate estimate_at(double x, double y) {
  PuckEstimate estimate;
  estimate.state = TrackState::kTracking;
  estimate.position = Pixel{x, y};
  return estimate;
}

}  // namespace

TEST_CASE("truth is linear between its rows and unknown beyond them") {
  const TruthTrack truth = moving_truth();
  CHECK(truth.at({15'000})->centre.x == doctest::Approx(11.5));
  CHECK(truth.at({20'000})->centre.x == 12);
  CHECK_FALSE(truth.at({-1}).has_value());
  CHECK_FALSE(truth.at({2'000'001}).has_value());
  CHECK(truth.first_motion() == Timestamp{60'000});
}

TEST_CASE("truth without rows or out of order is refused") {
  CHECK_THROWS_AS(TruthTrack({}), std::invalid_argument);
  CHECK_THROWS_AS(TruthTrack({{{10}, {}, {}, 1}, {{10}, {}, {}, 1}}), std::invalid_argument);
}

TEST_CASE("errors are distances and only ticks after the settling time count") {
  AccuracyScore score(moving_truth(), kSensor);
  for (int ms = 0; ms <= 1000; ++ms) {
    // 3 px right and 4 px down of the truth for every tick before 760 ms, exact after.
    const double off = ms < 760 ? 1 : 0;
    score.add({ms * 1000}, estimate_at(10 + ms / 10.0 + 3 * off, 100 + 4 * off));
  }
  const AccuracyReport report = score.report();
  CHECK(report.estimates == 741);  // 260 ms to 1000 ms
  CHECK(report.mean_px == doctest::Approx(5.0 * 500 / 741));
  CHECK(report.median_px == doctest::Approx(5));
  CHECK(report.p95_px == doctest::Approx(5));
  CHECK(report.within_2px_percent == doctest::Approx(100.0 * 241 / 741));
  CHECK(report.within_4px_percent == doctest::Approx(100.0 * 241 / 741));
  CHECK(report.lost_percent == 0);
  CHECK(report.time_to_first_track_ms == 0);
}

TEST_CASE("a tick without a position counts as 100 px off and as lost") {
  AccuracyScore score(moving_truth(), kSensor);
  for (int ms = 260; ms < 300; ++ms) score.add({ms * 1000}, PuckEstimate{});
  for (int ms = 300; ms < 360; ++ms) score.add({ms * 1000}, estimate_at(10 + ms / 10.0, 100));
  const AccuracyReport report = score.report();
  CHECK(report.estimates == 100);
  CHECK(report.mean_px == doctest::Approx(40));
  CHECK(report.lost_percent == doctest::Approx(40));
  CHECK(report.longest_loss_ms == doctest::Approx(40));
  CHECK(report.time_to_first_track_ms == doctest::Approx(240));
}

TEST_CASE("a distant position or a state other than tracking is lost") {
  AccuracyScore score(moving_truth(), kSensor);
  score.add({300'000}, estimate_at(40 + 20.5, 100));
  PuckEstimate right_but_lost = estimate_at(40, 100);
  right_but_lost.state = TrackState::kLost;
  score.add({300'000}, right_but_lost);
  score.add({300'000}, estimate_at(40 + 19.5, 100));
  CHECK(score.report().lost_percent == doctest::Approx(100.0 * 2 / 3));
}

TEST_CASE("a hidden puck and one outside the image do not count") {
  std::vector<TruthRow> rows{{{0}, {10, 10}, {30, 20}, 1},
                             {{100'000}, {39, 10}, {30, 20}, 1},
                             {{1'000'000}, {300, 10}, {30, 20}, 1},
                             {{1'000'001}, {300, 10}, {30, 20}, 0.4},
                             {{2'000'000}, {300, 10}, {30, 20}, 0.4},
                             {{2'000'001}, {-1, 10}, {30, 20}, 1},
                             {{3'000'000}, {-1, 10}, {30, 20}, 1}};
  AccuracyScore score(TruthTrack(rows), kSensor, {.truth_gap_us = 1'000'000});
  score.add({900'000}, estimate_at(271, 10));
  score.add({1'500'000}, estimate_at(0, 0));
  score.add({2'500'000}, estimate_at(0, 0));
  CHECK(score.report().estimates == 1);
}

TEST_CASE("a recording without countable ticks has no accuracy") {
  AccuracyScore score(moving_truth(), kSensor);
  CHECK(score.report().estimates == 0);
  CHECK_FALSE(score.report().time_to_first_track_ms.has_value());
}

TEST_CASE("a loss lasts only while the puck is visible") {
  std::vector<TruthRow> rows;
  for (int ms = 0; ms <= 1000; ++ms) {
    const bool hidden = ms > 400 && ms < 700;
    rows.push_back({{ms * 1000}, {10.0 + ms / 10.0, 100}, {30, 20}, hidden ? 0.0 : 1.0});
  }
  AccuracyScore score(TruthTrack(rows), kSensor);
  for (int ms = 300; ms <= 1000; ++ms) {
    const bool lost = ms > 390 && ms < 720;
    score.add({ms * 1000}, lost ? PuckEstimate{} : estimate_at(10 + ms / 10.0, 100));
  }
  // 391 to 400 ms, and 700 to 720 ms.
  CHECK(score.report().longest_loss_ms == doctest::Approx(29));
}

TEST_CASE("a report gives the spread of the errors") {
  AccuracyScore score(moving_truth(), kSensor);
  for (int ms = 301; ms <= 400; ++ms) {
    score.add({ms * 1000}, estimate_at(10 + ms / 10.0 + (ms - 300) / 100.0, 100));
  }
  const AccuracyReport report = score.report();
  CHECK(report.p5_px == doctest::Approx(0.05));
  CHECK(report.p25_px == doctest::Approx(0.25));
  CHECK(report.p75_px == doctest::Approx(0.75));
  CHECK(report.max_px == doctest::Approx(1));
  CHECK_FALSE(report.covariance.has_value());
  CHECK(report.score_curve.ticks() == 100);
}

TEST_CASE("between distant rows of truth nothing counts, and the share is reported") {
  std::vector<TruthRow> rows;
  for (int ms = 0; ms <= 1200; ms += ms == 600 ? 100 : 10) {
    rows.push_back({{ms * 1000}, {10.0 + ms / 10.0, 100}, {30, 20}, 1});
  }
  const auto counted = [&](const AccuracyParams& params) {
    AccuracyScore score(TruthTrack(rows), kSensor, params);
    for (int ms = 500; ms < 800; ++ms) score.add({ms * 1000}, estimate_at(10 + ms / 10.0, 100));
    return score.report();
  };
  // 601 to 699 ms.
  CHECK(counted({}).estimates == 201);
  CHECK(counted({}).truth_gap_percent == doctest::Approx(33));
  CHECK(counted({.truth_gap_us = 99'000}).estimates == 201);
  CHECK(counted({.truth_gap_us = 100'000}).estimates == 300);
  CHECK(counted({.truth_gap_us = 100'000}).truth_gap_percent == 0);
}

TEST_CASE("the settling time is the option's, else 200 ms, and zero with little truth") {
  const auto first_counted = [](std::int64_t truth_us, std::optional<std::int64_t> settle_us) {
    std::vector<TruthRow> rows;
    for (std::int64_t t_us = 0; t_us <= truth_us; t_us += 10'000) {
      rows.push_back({{t_us}, {10 + static_cast<double>(t_us) / 1000, 100}, {30, 20}, 1});
    }
    AccuracyScore score(TruthTrack(rows), kSensor, {.settle_us = settle_us});
    for (int ms = 0; ms <= 400; ++ms) score.add({ms * 1000}, estimate_at(10 + ms, 100));
    return score.samples().front().tick.us;
  };
  // It has moved 5 px at 10 ms, the first row beyond.
  CHECK(first_counted(1'200'000, std::nullopt) == 210'000);
  CHECK(first_counted(900'000, std::nullopt) == 10'000);
  CHECK(first_counted(900'000, 50'000) == 60'000);
  CHECK(first_counted(1'200'000, 0) == 10'000);
}

TEST_CASE("said and wrong is tracking far off, or for more than 50 ms after the puck was hidden") {
  std::vector<TruthRow> rows;
  for (int ms = 0; ms <= 1000; ++ms) {
    rows.push_back({{ms * 1000}, {100, 100}, {30, 20}, ms >= 500 && ms < 600 ? 0.0 : 1.0});
  }
  AccuracyScore score(TruthTrack(rows), kSensor);
  for (int ms = 0; ms < 1000; ++ms) {
    PuckEstimate estimate = estimate_at(ms < 10 ? 120.5 : 119.5, 100);
    if (ms >= 700) estimate = estimate_at(300, 100);
    if (ms >= 800) estimate.state = TrackState::kLost;
    score.add({ms * 1000}, estimate);
  }
  // 0 to 9, 551 to 599 and 700 to 799 ms.
  CHECK(score.report().said_and_wrong_percent.value() == doctest::Approx(15.9));
}

TEST_CASE("the paper's score takes the nearest estimate within 10 ms for each row of truth") {
  const std::vector<TruthRow> rows{{{100'000}, {50, 50}, {30, 20}, 1},
                                   {{200'000}, {60, 50}, {30, 20}, 1},
                                   {{300'000}, {70, 50}, {30, 20}, 0.2},
                                   {{400'000}, {80, 50}, {30, 20}, 1}};
  PaperScore score{TruthTrack(rows)};
  const auto add = [&](int ms, double x) {
    PuckEstimate estimate = estimate_at(x, 50);
    estimate.state = TrackState::kLost;
    score.add({ms * 1000}, estimate);
  };
  add(88, 0);
  add(96, 51);
  add(103, 53);
  score.add({100'000}, PuckEstimate{});
  add(209, 65);
  add(300, 0);
  add(411, 80);
  const PaperReport report = score.report();
  CHECK(report.truth_rows == 3);
  CHECK(report.estimates == 2);
  CHECK(report.mean_px == doctest::Approx(4));
  CHECK(report.std_px == doctest::Approx(1));
  CHECK(report.below_percent[0] == 0);
  CHECK(report.below_percent[3] == 0);
  CHECK(report.below_percent[4] == 50);
  CHECK(report.below_percent[5] == 50);
  CHECK(report.below_percent[29] == 100);
  CHECK(PaperScore{TruthTrack(rows)}.report().estimates == 0);
}

}  // namespace puck
