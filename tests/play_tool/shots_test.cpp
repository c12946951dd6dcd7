#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "tests/play_tool/play_bench.h"
#include "tools/play/error_fit.h"
#include "tools/play/error_model_check.h"
#include "tools/play/sweep.h"
#include "tools/play/whole_game.h"

namespace puck {
namespace {

// With this relative tolerance.
doctest::Approx within(double share, double value) {
  return doctest::Approx(value).epsilon(share).scale(0);
}

bool equal(const ShotOutcome& a, const ShotOutcome& b) {
  return a.end == b.end && a.cause == b.cause && a.tracked_share == b.tracked_share &&
         a.command_error_m == b.command_error_m && a.mallet_error_m == b.mallet_error_m &&
         a.settled_us == b.settled_us && a.belief == b.belief && a.played_us == b.played_us;
}

int saves_of(const std::vector<ShotOutcome>& outcomes) {
  return static_cast<int>(std::count_if(outcomes.begin(), outcomes.end(), [](const auto& outcome) {
    return outcome.end == ShotOutcome::End::kSaved;
  }));
}

TEST_CASE("Each shot has the specified speed, and hits the line within the goal") {
  const PlaySetup setup = fast_shots();
  const TableGeometry& table = setup.world.table;
  const auto shots = find_shots(setup, 1, kShots, 2);
  REQUIRE(static_cast<int>(shots.size()) == kShots);
  for (const ShotFacts& facts : shots) {
    CHECK(facts.is_shot);
    CHECK(facts.hit.us > 600'000);  // after the serve and the wait
    CHECK(facts.crossing > facts.hit);
    CHECK(facts.speed_m_s > 7.4);
    CHECK(facts.speed_m_s <= 15);
    CHECK(std::abs(facts.crossing_y_m) < table.width_m / 2);
  }
}

TEST_CASE("The same seed plays the same shots to the bit, with any number of threads") {
  const PlaySetup setup = fast_shots();
  const auto shots = find_shots(setup, 1, kShots, 1);
  const auto again = find_shots(setup, 1, kShots, 3);
  const auto others = find_shots(setup, 2, kShots, 3);
  const auto outcomes = play_shots(setup, shots, 1);
  const auto outcomes_again = play_shots(setup, again, 3);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    CHECK(shots[i].seed == again[i].seed);
    CHECK(shots[i].crossing_y_m == again[i].crossing_y_m);
    CHECK(equal(outcomes[i], outcomes_again[i]));
    CHECK(shots[i].crossing_y_m != others[i].crossing_y_m);
  }
}

TEST_CASE("A shot tracked by PUCK itself is reproducible to the bit, with or without images") {
  PlaySetup setup = fast_shots();
  const auto shots = find_shots(setup, 1, 1, 1);
  const auto without = play_shots(setup, shots, 1);
  setup.source = EstimateSource::kEvents;
  const auto first = play_shots(setup, shots, 2);
  // A repetition covers the same code, and takes long under sanitizers.
  if (!kIsSanitized) CHECK(equal(first[0], play_shots(setup, shots, 1)[0]));
  CHECK(first[0].tracked_share > 0.5);
  CHECK(first[0].end != ShotOutcome::End::kUnjudged);
  CHECK_FALSE(equal(first[0], without[0]));
}

TEST_CASE("A robot without estimates saves only shots at a mallet in the middle") {
  PlaySetup setup = fast_shots();
  setup.link.loss_percent = 100;
  const auto shots = find_shots(setup, 1, kShots, 2);
  const auto outcomes = play_shots(setup, shots, 2);
  int goals = 0;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    CHECK((outcomes[i].end == ShotOutcome::End::kSaved) == shots[i].hits_waiting_mallet);
    CHECK(outcomes[i].tracked_share == 0);
    // More than a puck's width beside the mallet, and straight into the goal.
    if (std::abs(shots[i].crossing_y_m) < 0.03) CHECK(shots[i].hits_waiting_mallet);
    if (outcomes[i].end != ShotOutcome::End::kGoal) continue;
    ++goals;
    CHECK(outcomes[i].cause ==
          (shots[i].is_reachable ? GoalCause::kNotTracked : GoalCause::kNotReachable));
  }
  CHECK(goals > kShots / 5);
}

TEST_CASE("An arm without limits or latency saves nearly all shots, and the bound all") {
  PlaySetup setup = fast_shots();
  setup.arm.arm = {.max_speed_m_s = 20, .max_acceleration_m_s2 = 1000, .max_jerk_m_s3 = 1e6};
  setup.link.latency_us = 0;
  setup.errors.loss_share = 0;
  setup.errors.notice_us = 0;
  const auto shots = find_shots(setup, 1, kShots, 2);
  for (const ShotFacts& facts : shots) CHECK(facts.is_reachable);
  CHECK(saves_of(play_shots(setup, shots, 2)) >= kShots - 1 - kShots / 20);
}

TEST_CASE("A larger latency saves fewer shots") {
  PlaySetup setup = fast_shots();
  const auto shots = find_shots(setup, 1, kShots, 2);
  const int at_once = saves_of(play_shots(setup, shots, 2));
  setup.link.latency_us = 80'000;
  CHECK(saves_of(play_shots(setup, shots, 2)) < at_once);
}

TEST_CASE("A whole game's counts equal its referee's, and it lasts the specified time") {
  PlaySetup setup = fast_shots();
  setup.world.game = {};
  const double seconds = 1.5 * kShots;
  const SaveFigures game = play_game(setup, 3, seconds);
  CHECK(game.played_s == doctest::Approx(seconds));
  CHECK(game.shots > 0);
  CHECK(game.saves + game.goals <= game.shots + 1);  // a goal needs no shot
  CHECK_FALSE(game.bound_percent());
  CHECK_FALSE(game.causes);
  const SaveFigures again = play_game(setup, 3, seconds);
  CHECK(again.shots == game.shots);
  CHECK(again.saves == game.saves);
}

TEST_CASE("The fit of the errors recovers the model's parameters") {
  PlaySetup setup = fast_shots();
  setup.errors = {.sigma_x_px = 0.3,
                  .sigma_y_px = 0.2,
                  .correlation_us = 5'000,
                  .bias_x_px = 0.1,
                  .bias_y_px = -0.1,
                  .lag_us = 100,
                  .reported_sigma_px = 0.25,
                  .detection_us = 100'000,
                  .notice_us = 4'000,
                  .loss_share = 0.3,
                  .loss_us = 8'000};
  const auto shots = find_shots(setup, 1, 5 * kShots, 2);
  std::vector<FlightErrors> flights;
  for (const ShotFacts& facts : shots) flights.push_back(watch_flight(setup, facts));
  const EstimateErrorParams fit = fit_estimate_errors(flights, 1'000);
  CHECK(fit.reported_sigma_px == within(0.01, 0.25));
  CHECK(fit.detection_us == within(0.02, 100'000));
  // The few shots under sanitizers do not determine random quantities.
  if (kIsSanitized) return;
  CHECK(fit.sigma_x_px == within(0.25, 0.3));
  CHECK(fit.sigma_y_px == within(0.25, 0.2));
  CHECK(fit.correlation_us == within(0.5, 5'000));
  CHECK(fit.lag_us == within(0.5, 100));
  CHECK(fit.notice_us == within(0.3, 4'000));
  CHECK(fit.loss_share == within(0.5, 0.3));
  CHECK(fit.loss_us == within(0.6, 8'000));
}

TEST_CASE("The built-in errors are about those of PUCK on events" * doctest::test_suite("deep") *
          doctest::skip(kIsSanitized)) {
  PlaySetup setup = fast_shots();
  const EstimateErrorParams built_in = setup.errors;
  setup.source = EstimateSource::kEvents;
  std::vector<FlightErrors> flights;
  for (const ShotFacts& facts : find_shots(setup, 1, 8, 2)) {
    flights.push_back(watch_flight(setup, facts));
  }
  const EstimateErrorParams fit = fit_estimate_errors(flights, 1'000);
  // From eight shots: tools/play/estimate_errors.h explains the fit.
  CHECK(fit.sigma_x_px == within(0.4, built_in.sigma_x_px));
  CHECK(fit.sigma_y_px == within(0.4, built_in.sigma_y_px));
  CHECK(fit.correlation_us == within(0.5, built_in.correlation_us));
  CHECK(fit.reported_sigma_px == within(0.2, built_in.reported_sigma_px));
  CHECK(fit.detection_us == within(0.3, built_in.detection_us));
  CHECK(std::abs(fit.bias_x_px - built_in.bias_x_px) < 0.05);
  CHECK(std::abs(fit.bias_y_px - built_in.bias_y_px) < 0.05);
  CHECK(std::abs(fit.lag_us - built_in.lag_us) < 50);
  CHECK(std::abs(fit.notice_us - built_in.notice_us) < 1'500);
  CHECK(std::abs(fit.loss_share - built_in.loss_share) < 0.1);
}

TEST_CASE("A sweep plays the same shots at each of its points") {
  PlannedSweep plan = plan_sweep("latency", fast_shots(), 15);
  CHECK(plan.points.size() == 4 * 8);
  CHECK(plan.points.front().setup.link.latency_us == 1'000);
  CHECK(plan.points[7].setup.link.latency_us == 101'000);
  plan.points = {plan.points[0], plan.points[6], plan.points[31]};
  int seen = 0;
  const Sweep sweep = run_sweep(plan, {.shots = kShots / 2, .seed = 1, .jobs = 2},
                                [&](const SweepPoint&) { ++seen; });
  CHECK(seen == 3);
  REQUIRE(sweep.points.size() == 3);
  for (const SweepPoint& point : sweep.points) {
    CHECK(point.figures.shots == kShots / 2);
    CHECK(point.figures.bound_percent() == sweep.points[0].figures.bound_percent());
    CHECK(point.figures.waiting_percent() == sweep.points[0].figures.waiting_percent());
  }
  // 133 ms after the exposure the bridge rejects an estimate.
  CHECK(sweep.points[2].figures.save_percent() == sweep.points[2].figures.waiting_percent());
}

TEST_CASE("The help names exactly the existing sweeps") {
  const PlaySetup setup = fast_shots();
  for (const char* name : {"latency", "speed", "rate", "loss"}) {
    CHECK(plan_sweep(name, setup, 15).points.size() > 20);
  }
  CHECK_THROWS_WITH(plan_sweep("size", setup, 15),
                    "--sweep takes latency, speed, loss or rate, got size");
}

}  // namespace
}  // namespace puck
