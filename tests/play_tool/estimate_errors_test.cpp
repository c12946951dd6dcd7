#include "tools/play/estimate_errors.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "tests/play_tool/play_bench.h"

namespace puck {
namespace {

// A puck that moves up and down the image, far from its edges.
class Glide {
 public:
  const SimulatedTruth& next() {
    truth_.time = truth_.time + kStepUs;
    truth_.in_play = true;
    truth_.velocity = {-1, 0};
    truth_.position_px = {300 + 100 * std::sin(phase()), 200};
    return truth_;
  }
  double speed_px_s() const { return 100 * kTurns_1_s * std::cos(phase()); }
  SimulatedTruth& truth() { return truth_; }

 private:
  static constexpr double kTurns_1_s = 5;
  double phase() const { return 1e-6 * kTurns_1_s * static_cast<double>(truth_.time.us); }

  SimulatedTruth truth_;
};

EstimateErrorParams still_errors() {
  EstimateErrorParams params;
  params.detection_us = 0;
  params.loss_share = 0;
  params.notice_us = 0;
  params.lag_us = params.bias_x_px = params.bias_y_px = 0;
  return params;
}

TEST_CASE("The error has the specified spread, correlation time and bias") {
  EstimateErrorParams params = still_errors();
  params.sigma_x_px = 0.5;
  params.sigma_y_px = 0.2;
  params.correlation_us = 4000;
  params.bias_y_px = 1;
  EstimateErrors errors(params, kSensor, 7);
  Glide glide;
  constexpr int kTicks = 200'000;
  constexpr int kMemory = 4000 / kStepUs;
  std::vector<double> x;
  double sum_y = 0;
  double square_y = 0;
  for (int i = 0; i < kTicks; ++i) {
    const SimulatedTruth& truth = glide.next();
    errors.watch(truth);
    const PuckEstimate estimate = errors.estimate();
    REQUIRE(estimate.position);
    x.push_back(estimate.position->x - truth.position_px.x);
    const double y = estimate.position->y - truth.position_px.y;
    sum_y += y;
    square_y += (y - 1) * (y - 1);
  }
  double square_x = 0;
  double together = 0;
  for (std::size_t i = 0; i + kMemory < x.size(); ++i) {
    square_x += x[i] * x[i];
    together += x[i] * x[i + kMemory];
  }
  // 200 000 ticks are 5 000 independent ones: 4 standard deviations are 4 %.
  CHECK(std::sqrt(square_x / kTicks) == doctest::Approx(0.5).epsilon(0.04));
  CHECK(std::sqrt(square_y / kTicks) == doctest::Approx(0.2).epsilon(0.04));
  CHECK(sum_y / kTicks == doctest::Approx(1).epsilon(0.02));
  CHECK(together / square_x == doctest::Approx(std::exp(-1)).epsilon(0.15));
}

TEST_CASE("A lag leaves the estimate behind by the puck's speed") {
  EstimateErrorParams params = still_errors();
  params.sigma_x_px = params.sigma_y_px = 0;
  params.lag_us = 1000;
  EstimateErrors errors(params, kSensor, 1);
  Glide glide;
  for (int i = 0; i < 500; ++i) {
    const SimulatedTruth& truth = glide.next();
    errors.watch(truth);
    if (i == 0) continue;
    const double error_px = errors.estimate().position->x - truth.position_px.x;
    CHECK(error_px == doctest::Approx(-1e-3 * glide.speed_px_s()).epsilon(0.02).scale(0.5));
  }
}

TEST_CASE("After a turn the estimate continues straight until the turn is noticed") {
  EstimateErrorParams params = still_errors();
  params.sigma_x_px = params.sigma_y_px = 0;
  params.notice_us = 3000;
  EstimateErrors errors(params, kSensor, 1);
  SimulatedTruth truth;
  truth.in_play = true;
  truth.position_px = {300, 200};
  truth.velocity = {-1, 0};
  const auto step_to = [&](double x_px) {
    truth.time = truth.time + kStepUs;
    truth.position_px.x = x_px;
    errors.watch(truth);
    return errors.estimate().position->x;
  };
  for (int i = 1; i <= 10; ++i) CHECK(step_to(300 + i) == doctest::Approx(300 + i));
  truth.velocity = {1, 0};
  for (int i = 1; i <= 15; ++i) CHECK(step_to(310 - i) == doctest::Approx(310 + i));
  CHECK(step_to(294) == doctest::Approx(294));
}

TEST_CASE("The puck is lost after the specified share of turns, for the specified time") {
  EstimateErrorParams params = still_errors();
  params.loss_share = 0.25;
  params.loss_us = 10'000;
  EstimateErrors errors(params, kSensor, 3);
  Glide glide;
  int losses = 0;
  double lost_us = 0;
  constexpr int kTurns = 2000;
  for (int turn = 0; turn < kTurns; ++turn) {
    bool was_lost = false;
    for (int i = 0; i < 500; ++i) {
      SimulatedTruth truth = glide.next();
      truth.velocity.x_m_s = turn % 2 == 0 ? -1 : 1;
      errors.watch(truth);
      if (errors.estimate().state == TrackState::kTracking) continue;
      was_lost = true;
      lost_us += kStepUs;
    }
    if (was_lost) ++losses;
  }
  CHECK(losses == doctest::Approx(0.25 * kTurns).epsilon(0.15));
  CHECK(lost_us / losses == doctest::Approx(10'000).epsilon(0.15));
}

TEST_CASE("A puck that enters the game is searched for; one outside the image is lost") {
  EstimateErrorParams params = still_errors();
  params.detection_us = 1000;
  EstimateErrors errors(params, kSensor, 1);
  CHECK(errors.estimate().state == TrackState::kSearching);
  Glide glide;
  for (int i = 0; i < 5; ++i) errors.watch(glide.next());
  CHECK(errors.estimate().state == TrackState::kSearching);
  errors.watch(glide.next());
  CHECK(errors.estimate().state == TrackState::kTracking);
  glide.truth().position_px = {-1, 200};
  SimulatedTruth outside = glide.truth();
  outside.time = outside.time + kStepUs;
  errors.watch(outside);
  CHECK(errors.estimate().state == TrackState::kLost);
  CHECK_FALSE(errors.estimate().position);
}

}  // namespace
}  // namespace puck
