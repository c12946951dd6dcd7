#include "common/table/motion_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/table/test_table.h"

namespace puck {
namespace {

// Gives a filter a true motion as measurements with noise, one a millisecond.
class Player {
 public:
  Player(const PuckMotion& motion, PuckTrack truth, double noise_m)
      : motion_(motion), truth_(truth), noise_(0, noise_m) {}

  MeasurementUse step(MotionFilter& filter) {
    truth_ = motion_.advance(truth_, 0.001).track;
    t_ = t_ + 1000;
    const double variance = noise_.stddev() * noise_.stddev();
    TableMeasurement m{t_, truth_.state.position, variance * Matrix2::Identity()};
    m.position.x_m += noise_(random_);
    m.position.y_m += noise_(random_);
    return filter.update(m);
  }
  void skip(int steps) {
    truth_ = motion_.advance(truth_, 0.001 * steps).track;
    t_ = t_ + 1000 * steps;
  }
  void hit(TableVelocity velocity) { truth_.state.velocity = velocity; }

  const PuckState& truth() const { return truth_.state; }
  Timestamp t() const { return t_; }

 private:
  const PuckMotion& motion_;
  PuckTrack truth_;
  Timestamp t_{1'000'000};
  std::normal_distribution<double> noise_;
  std::mt19937 random_{3};
};

double position_error(const PuckTrack& track, const PuckState& truth) {
  return std::hypot(track.state.position.x_m - truth.position.x_m,
                    track.state.position.y_m - truth.position.y_m);
}

double velocity_error(const PuckTrack& track, const PuckState& truth) {
  return std::hypot(track.state.velocity.x_m_s - truth.velocity.x_m_s,
                    track.state.velocity.y_m_s - truth.velocity.y_m_s);
}

TEST_CASE("The filter estimates the velocity from positions alone and smooths their noise") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Player player(motion, {{{1.8, -0.3}, {-2, 0.8}}, {}}, 0.002);
  for (int i = 0; i < 300; ++i) player.step(filter);
  const std::optional<PuckTrack> track = filter.at(player.t());
  REQUIRE(track);
  CHECK(position_error(*track, player.truth()) < 0.002);
  CHECK(velocity_error(*track, player.truth()) < 0.15);
  CHECK(track->covariance(0, 0) > 0);
  CHECK(std::sqrt(track->covariance(2, 2)) < 0.3);
}

TEST_CASE("The filter follows the puck through bounces at the rails without losing a measurement") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Player player(motion, {{{1.0, 0}, {0.3, 3}}, {}}, 0.001);
  int not_used = 0;
  for (int i = 0; i < 1000; ++i) {
    const MeasurementUse use = player.step(filter);
    if (i > 0 && use != MeasurementUse::kUsed) ++not_used;
  }
  CHECK(not_used == 0);
  CHECK(position_error(*filter.at(player.t()), player.truth()) < 0.003);
}

TEST_CASE("The filter predicts through a short loss and a bounce within it") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Player player(motion, {{{1.5, 0}, {-1, 2}}, {}}, 0.0005);
  for (int i = 0; i < 170; ++i) player.step(filter);
  CHECK(player.truth().velocity.y_m_s > 0);
  player.skip(60);
  CHECK(player.truth().velocity.y_m_s < 0);
  REQUIRE(filter.at(player.t()));
  CHECK(position_error(*filter.at(player.t()), player.truth()) < 0.01);
}

TEST_CASE("The track ends 100 ms after the last good measurement and restarts with the next") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  CHECK_FALSE(filter.at({0}));
  CHECK(filter.update({{1000}, {1, 0}}) == MeasurementUse::kStarted);
  CHECK(filter.at({101'000}));
  CHECK_FALSE(filter.at({101'001}));
  CHECK_FALSE(filter.at({999}));
  CHECK(filter.update({{200'000}, {0.5, 0.2}}) == MeasurementUse::kStarted);
  CHECK(filter.at({200'000})->state.position.x_m == doctest::Approx(0.5));
}

TEST_CASE("A single outlier changes nothing") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Player player(motion, {{{1.8, 0}, {-1, 0}}, {}}, 0.001);
  for (int i = 0; i < 100; ++i) player.step(filter);
  const PuckTrack before = *filter.at(player.t() + 500);
  CHECK(filter.update({player.t() + 500, {0.4, -0.3}}) == MeasurementUse::kOutlier);
  CHECK(filter.at(player.t() + 500)->state.position == before.state.position);
  CHECK(player.step(filter) == MeasurementUse::kUsed);
}

TEST_CASE("A hit in any direction is followed within a few milliseconds") {
  const PuckMotion motion(kTable);
  for (const TableVelocity after : {TableVelocity{-4, -1}, {3, 2}, {-0.5, 3}, {-12, 0}}) {
    CAPTURE(after.x_m_s);
    MotionFilter filter(motion);
    Player player(motion, {{{1.2, 0.1}, {0.5, 0}}, {}}, 0.0003);
    for (int i = 0; i < 100; ++i) player.step(filter);
    player.hit(after);
    int after_ms = 0;
    for (int i = 1; i <= 20; ++i) {
      if (player.step(filter) == MeasurementUse::kHit) after_ms = i;
    }
    CHECK(after_ms >= 2);
    CHECK(after_ms <= 6);
    CHECK(filter.hits() == 1);
    CHECK(filter.jumps() == 0);
    CHECK(position_error(*filter.at(player.t()), player.truth()) < 0.003);
    CHECK(velocity_error(*filter.at(player.t()), player.truth()) < 0.5);
  }
}

TEST_CASE("A sudden new place of the puck is accepted only after 20 ms, and counted as a jump") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Player player(motion, {{{1.5, 0.2}, {0.5, 0}}, {}}, 0.0003);
  for (int i = 0; i < 100; ++i) player.step(filter);
  const TablePoint before = filter.at(player.t())->state.position;
  int jumped_after_ms = 0;
  for (int i = 1; i <= 40 && jumped_after_ms == 0; ++i) {
    const Timestamp t = player.t() + 1000 * i;
    const MeasurementUse use = filter.update({t, {0.5, -0.3}});
    if (use == MeasurementUse::kJumped) jumped_after_ms = i;
    if (use == MeasurementUse::kOutlier) {
      CHECK(std::abs(filter.at(t)->state.position.x_m - before.x_m) < 0.05);
    }
  }
  CHECK(jumped_after_ms == 21);
  CHECK(filter.jumps() == 1);
  CHECK(filter.hits() == 0);
}

// The track moves from a puck at rest to the mallet that hits it. Returns the use of the tracker's
// `place`, 3 ms after the hit, and the time until the shot is followed.
std::pair<MeasurementUse, int> after_straying(const TablePoint& place,
                                              const TableVelocity& velocity) {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Timestamp t{1'000'000};
  const auto see = [&](const TablePoint& at, const TableVelocity& moving) {
    t = t + 1000;
    return filter.update({t, at, 1e-6 * Matrix2::Identity(), moving});
  };
  for (int i = 0; i < 100; ++i) see({1.4, -0.2}, {});
  for (int i = 0; i < 16; ++i) see({1.4 + 0.005 * i, -0.2}, {5, 0});
  REQUIRE(filter.at(t)->state.position.x_m > 1.45);
  for (int i = 0; i < 40; ++i) {
    const double ms = 0.001 * i;
    const MeasurementUse use =
        see({place.x_m + ms * velocity.x_m_s, place.y_m + ms * velocity.y_m_s}, velocity);
    if (use != MeasurementUse::kOutlier) return {use, i};
  }
  return {MeasurementUse::kOutlier, 40};
}

TEST_CASE("A shot whose hit the mallet hid is followed like any other hit") {
  for (const TableVelocity shot : {TableVelocity{-12, 0.9}, {-9, 8}, {-4, -1}}) {
    CAPTURE(shot.x_m_s);
    const TablePoint place{1.4 + 0.003 * shot.x_m_s, -0.2 + 0.003 * shot.y_m_s};
    const auto [use, ms] = after_straying(place, shot);
    CHECK(use == MeasurementUse::kHit);
    CHECK(ms <= 3);
  }
}

TEST_CASE("A jump, or a motion impossible after a hit there, is no missed hit") {
  const std::pair<TablePoint, TableVelocity> leaps[] = {
      {{1.2, 0.2}, {}},         // at rest
      {{1.2, 0.2}, {0, -6}},    // past where the puck was
      {{1.2, -0.2}, {4, 0}},    // towards there
      {{0.6, -0.2}, {-12, 0}},  // too far away for so few ms
      {{1.36, 0.2}, {-12, 0}},  // the mirror image
  };
  for (const auto& leap : leaps) {
    CAPTURE(leap.first.x_m);
    CAPTURE(leap.first.y_m);
    const auto [use, ms] = after_straying(leap.first, leap.second);
    CHECK(use == MeasurementUse::kJumped);
    CHECK(ms >= 20);
  }
}

TEST_CASE("Contradictory outliers never begin a track") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Player player(motion, {{{1.5, 0.2}, {0.5, 0}}, {}}, 0.0003);
  for (int i = 0; i < 100; ++i) player.step(filter);
  for (int i = 1; i < 90; ++i) {
    const double y = i % 2 == 0 ? -0.3 : 0.35;
    CHECK(filter.update({player.t() + 1000 * i, {0.5 + 0.01 * (i % 7), y}}) ==
          MeasurementUse::kOutlier);
  }
}

// A game's measurements with a bounce, a hit and outliers among them.
std::vector<TableMeasurement> eventful_measurements() {
  const PuckMotion motion(kTable);
  PuckTrack truth{{{1.5, 0.2}, {-1, 2}}, {}};
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0, 0.0005);
  std::vector<TableMeasurement> measurements;
  for (int i = 0; i < 400; ++i) {
    truth = motion.advance(truth, 0.001).track;
    if (i == 230) truth.state.velocity = {3, -1};
    TableMeasurement m{
        {1'000'000 + 1000 * i},
        {truth.state.position.x_m + noise(random), truth.state.position.y_m + noise(random)},
        1e-7 * Matrix2::Identity(),
        truth.state.velocity};
    if (i % 37 == 36) m.position.x_m -= 0.2;
    m.resting = i == 390;
    measurements.push_back(m);
  }
  return measurements;
}

TEST_CASE("The track does not depend on the order of the measurements in a window") {
  const PuckMotion motion(kTable);
  const std::vector<TableMeasurement> in_order = eventful_measurements();
  std::mt19937 random(4);
  for (const std::size_t window : {2, 5, 16, 32}) {
    CAPTURE(window);
    std::vector<TableMeasurement> shuffled = in_order;
    // Both orders begin the track with the first.
    for (std::size_t i = 1; i < shuffled.size(); i += window) {
      const std::size_t end = std::min(i + window, shuffled.size());
      std::shuffle(shuffled.begin() + static_cast<std::ptrdiff_t>(i),
                   shuffled.begin() + static_cast<std::ptrdiff_t>(end), random);
    }
    MotionFilter expected(motion);
    MotionFilter filter(motion);
    for (std::size_t i = 0; i < in_order.size(); ++i) {
      expected.update(in_order[i]);
      CHECK(filter.update(shuffled[i]) != MeasurementUse::kLate);
      if (i % window != 0) continue;
      REQUIRE(filter.newest() == expected.newest());
      const PuckTrack a = *expected.at(*expected.newest());
      const PuckTrack b = *filter.at(*filter.newest());
      CHECK(a.state.position == b.state.position);
      CHECK(a.state.velocity.x_m_s == b.state.velocity.x_m_s);
      CHECK(a.covariance == b.covariance);
    }
    CHECK(filter.hits() == expected.hits());
    CHECK(filter.hits() >= 1);
    CHECK(filter.jumps() == 0);
  }
}

TEST_CASE("A measurement older than the window is late, and so is a repeated one") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  const std::vector<TableMeasurement> measurements = eventful_measurements();
  for (const TableMeasurement& m : measurements) filter.update(m);
  const PuckTrack before = *filter.at(measurements.back().t);
  const std::size_t oldest_kept = measurements.size() - MotionFilter::kHistory;
  TableMeasurement old = measurements[oldest_kept];
  old.t = old.t + -500;
  old.position.x_m += 0.001;
  CHECK(filter.update(old) == MeasurementUse::kLate);
  CHECK(filter.update(measurements[oldest_kept + 3]) == MeasurementUse::kLate);
  CHECK(filter.at(measurements.back().t)->state.position == before.state.position);
}

TEST_CASE("Measurements with a common error gain no weight by a higher rate") {
  const PuckMotion motion(kTable);
  const auto sigma_at_rate = [&](std::int64_t period_us) {
    MotionFilter filter(motion);
    for (std::int64_t t = 0; t <= 200'000; t += period_us) filter.update({{t}, {1, 0}});
    return std::sqrt(filter.at({200'000})->covariance(0, 0));
  };
  CHECK(sigma_at_rate(200) == doctest::Approx(sigma_at_rate(2000)).epsilon(0.25));
}

TEST_CASE("Repeated measurements are dropped, but a resting puck may repeat its time") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  filter.update({{10'000}, {1, 0}, {}, {3, 0}});
  CHECK(filter.update({{10'000}, {1, 0}}) == MeasurementUse::kLate);
  TableMeasurement resting{{10'000}, {1, 0}};
  resting.resting = true;
  CHECK(filter.update(resting) == MeasurementUse::kUsed);
  CHECK(filter.at({10'000})->state.velocity.x_m_s == 0);
}

TEST_CASE("Measurements that are not finite, or with an invalid covariance, are rejected") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(filter.update({{1}, {nan, 0}}) == MeasurementUse::kRejected);
  CHECK(filter.update({{1}, {1, 0}, Matrix2{{1, 0}, {0, -1}}}) == MeasurementUse::kRejected);
  CHECK(filter.update({{1}, {1, 0}, Matrix2{{1, 2}, {2, 1}}}) == MeasurementUse::kRejected);
  CHECK_FALSE(filter.at({1}));
}

TEST_CASE("Filter parameters out of range are refused by name") {
  MotionFilterParams params;
  params.gate_sigmas = 0;
  CHECK_THROWS_WITH_AS(MotionFilter(PuckMotion(kTable), params),
                       "filter.gate_sigmas must be between 1 and 100", std::invalid_argument);
}

}  // namespace
}  // namespace puck
