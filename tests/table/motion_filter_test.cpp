#include "common/table/motion_filter.h"

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr TableGeometry kTable{2.0, 1.0, 0.4, 0.1, 0.05, 0.15, 0.3};

// Plays a true motion to a filter as measurements with noise, one a millisecond.
class Player {
 public:
  Player(const PuckMotion& motion, PuckTrack truth, double noise_m)
      : motion_(motion), truth_(truth), noise_(0, noise_m) {}

  MeasurementUse step(MotionFilter& filter) {
    truth_ = motion_.advance(truth_, 0.001).track;
    t_ = t_ + 1000;
    TableMeasurement m{t_, truth_.state.position};
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

TEST_CASE("The filter finds the velocity from positions alone and smooths their noise") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Player player(motion, {{{1.8, -0.3}, {-2, 0.8}}, {}}, 0.002);
  for (int i = 0; i < 300; ++i) player.step(filter);
  const std::optional<PuckTrack> track = filter.at(player.t());
  REQUIRE(track);
  CHECK(position_error(*track, player.truth()) < 0.002);
  CHECK(velocity_error(*track, player.truth()) < 0.15);
  CHECK(track->covariance[0] > 0);
  CHECK(std::sqrt(track->covariance[10]) < 0.3);
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

TEST_CASE("The track ends 100 ms after the last good measurement and begins anew with the next") {
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

TEST_CASE("A lone outlier moves nothing") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Player player(motion, {{{1.8, 0}, {-1, 0}}, {}}, 0.001);
  for (int i = 0; i < 100; ++i) player.step(filter);
  const PuckTrack before = *filter.at(player.t() + 500);
  CHECK(filter.update({player.t() + 500, {0.4, -0.3}}) == MeasurementUse::kOutlier);
  CHECK(filter.at(player.t() + 500)->state.position == before.state.position);
  CHECK(player.step(filter) == MeasurementUse::kUsed);
}

TEST_CASE("Outliers that agree for 5 ms begin a new track, as after a hit") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  Player player(motion, {{{1.5, 0.2}, {0.5, 0}}, {}}, 0.001);
  for (int i = 0; i < 200; ++i) player.step(filter);
  player.hit({-4, -1});
  int started = 0;
  for (int i = 0; i < 60; ++i) started += player.step(filter) == MeasurementUse::kStarted ? 1 : 0;
  CHECK(started == 1);
  CHECK(position_error(*filter.at(player.t()), player.truth()) < 0.005);
  CHECK(velocity_error(*filter.at(player.t()), player.truth()) < 0.4);
}

TEST_CASE("Measurements that share their errors are not trusted more for coming more often") {
  const PuckMotion motion(kTable);
  const auto sigma_at_rate = [&](std::int64_t period_us) {
    MotionFilter filter(motion);
    for (std::int64_t t = 0; t <= 200'000; t += period_us) filter.update({{t}, {1, 0}});
    return std::sqrt(filter.at({200'000})->covariance[0]);
  };
  CHECK(sigma_at_rate(200) == doctest::Approx(sigma_at_rate(2000)).epsilon(0.25));
}

TEST_CASE("Late and repeated measurements are dropped, but a resting puck may repeat its time") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  filter.update({{10'000}, {1, 0}, {}, {3, 0}});
  CHECK(filter.update({{9'000}, {1, 0}}) == MeasurementUse::kLate);
  CHECK(filter.update({{10'000}, {1, 0}}) == MeasurementUse::kLate);
  TableMeasurement resting{{10'000}, {1, 0}};
  resting.resting = true;
  CHECK(filter.update(resting) == MeasurementUse::kUsed);
  CHECK(filter.at({10'000})->state.velocity.x_m_s == 0);
}

TEST_CASE("Measurements that are not finite, or whose covariance is none, are rejected") {
  const PuckMotion motion(kTable);
  MotionFilter filter(motion);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(filter.update({{1}, {nan, 0}}) == MeasurementUse::kRejected);
  CHECK(filter.update({{1}, {1, 0}, {1, 0, 0, -1}}) == MeasurementUse::kRejected);
  CHECK(filter.update({{1}, {1, 0}, {1, 2, 2, 1}}) == MeasurementUse::kRejected);
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
