#include "common/calibration/motion_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/simulation/physics_params.h"
#include "common/table/puck_motion.h"
#include "tests/calibration/flown_game.h"
#include "tests/support/contains.h"
#include "tests/support/sanitizers.h"

namespace puck {
namespace {

constexpr double kSeconds = kIsSanitized ? 60 : 90;
// A fit's time grows with its places.
constexpr std::int64_t kPeriodUs = kIsSanitized ? 10'000 : 2'000;

MotionFit fit_of(const FlownGame& game) {
  return fit_motion(find_flights(game.track(), game.world.table), game.world.table);
}

std::string refusal_of_track(const std::vector<TrackPoint>& track) {
  const TableGeometry table;
  try {
    fit_motion(find_flights(track, table), table);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

void check_within(double fitted, double error, double truth) {
  CAPTURE(fitted);
  CAPTURE(error);
  CAPTURE(truth);
  CHECK(std::abs(fitted - truth) < 3 * error);
}

void check_finds(const MotionFit& fit, const PhysicsParams& truth) {
  MESSAGE(fit.flights, " flights, ", fit.bounces, " bounces, ", fit.rejected, " rejected, ",
          1e3 * fit.rms_m, " mm");
  const MotionConstants& error = fit.standard_error;
  MESSAGE("damping ", fit.constants.damping_per_s, " +- ", error.damping_per_s);
  MESSAGE("restitution ", fit.constants.rail_restitution, " +- ", error.rail_restitution);
  MESSAGE("grip ", fit.constants.rail_grip, " +- ", error.rail_grip);
  check_within(fit.constants.damping_per_s, error.damping_per_s, truth.damping_1_s);
  check_within(fit.constants.rail_restitution, error.rail_restitution, truth.rail_normal_keep);
  check_within(fit.constants.rail_grip, error.rail_grip, truth.rail_tangential_keep);
  CHECK(error.damping_per_s < 0.01);
  CHECK(error.rail_restitution < 0.01);
  CHECK(error.rail_grip < 0.01);
}

TEST_CASE("The fit recovers a simulated game's motion within its standard errors") {
  FlownGame game;
  game.seconds = kSeconds;
  const MotionFit fit = fit_of(game);
  check_finds(fit, game.world.physics);
  CHECK(fit.bounces > kSeconds / 6);
  CHECK(fit.rejected < fit.flights / 4);
  CHECK(fit.rms_m == doctest::Approx(std::sqrt(2.0) * game.noise_m).epsilon(0.3));
}

TEST_CASE("The fit recovers the motion of a dull and a lively table, with a slow tracker") {
  const std::array tables{PhysicsParams{0.05, 0.95, 0.98}, PhysicsParams{0.6, 0.6, 0.7}};
  // Under sanitizers one is enough.
  for (const PhysicsParams& physics : std::span(tables).last(kIsSanitized ? 1 : 2)) {
    FlownGame game;
    game.seconds = 90;  // A dull table has few bounces.
    game.period_us = 10'000;
    game.world.physics.damping_1_s = physics.damping_1_s;
    game.world.physics.rail_normal_keep = physics.rail_normal_keep;
    game.world.physics.rail_tangential_keep = physics.rail_tangential_keep;
    check_finds(fit_of(game), game.world.physics);
  }
}

TEST_CASE("The standard errors match the fit's scatter between games") {
  double squares = 0;
  double count = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    FlownGame game;
    game.seconds = kSeconds / 2;
    game.period_us = kPeriodUs;
    game.world.seed = seed;
    const MotionFit fit = fit_of(game);
    const PhysicsParams& truth = game.world.physics;
    const auto add = [&](double fitted, double error, double is) {
      squares += (fitted - is) * (fitted - is) / (error * error);
      count += 1;
    };
    add(fit.constants.damping_per_s, fit.standard_error.damping_per_s, truth.damping_1_s);
    add(fit.constants.rail_restitution, fit.standard_error.rail_restitution,
        truth.rail_normal_keep);
    add(fit.constants.rail_grip, fit.standard_error.rail_grip, truth.rail_tangential_keep);
  }
  MESSAGE("errors over standard errors, rms: ", std::sqrt(squares / count));
  CHECK(std::sqrt(squares / count) > 0.4);
  CHECK(std::sqrt(squares / count) < 1.8);
}

TEST_CASE("A flight ends at mallet hits, at gaps and before goals, not at rails") {
  const TableGeometry table;
  const PuckMotion motion(table);
  // Off the side rail at 0.3 s, hit at 0.6 s.
  PuckTrack puck{{{1, 0.3}, {-0.5, 1}}, {}};
  std::vector<TrackPoint> track;
  for (int ms = 0; ms < 1000; ms += 2) {
    if (ms == 600) puck.state.velocity = {2, 0.4};
    track.push_back({Timestamp{1000 * ms}, puck.state.position});
    puck = motion.advance(puck, 0.002).track;
  }
  const auto flights = find_flights(track, table);
  REQUIRE(flights.size() == 2);
  CHECK(flights[0].front().t == Timestamp{0});
  CHECK(flights[0].back().t < Timestamp{600'000});
  CHECK(flights[0].back().t > Timestamp{560'000});
  CHECK(flights[1].front().t > Timestamp{600'000});
  CHECK(flights[1].front().t < Timestamp{640'000});

  const auto at = [&](std::size_t i) { return track.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<TrackPoint> with_gap = track;
  with_gap.erase(with_gap.begin() + 100, with_gap.begin() + 120);
  CHECK(find_flights(with_gap, table).size() == 3);
  // Another recording follows.
  std::vector<TrackPoint> twice(at(0), at(200));
  twice.insert(twice.end(), at(0), at(200));
  CHECK(find_flights(twice, table).size() == 2);

  std::vector<TrackPoint> goal;
  for (int ms = 0; ms < 300; ms += 2)
    goal.push_back({Timestamp{1000 * ms}, {0.2 - 1e-3 * ms, 0.1}});
  REQUIRE(find_flights(goal, table).size() == 1);
  CHECK(find_flights(goal, table)[0].back().position.x_m > table.puck_radius_m);
}

TEST_CASE("Too little data is refused with the reason") {
  CHECK(contains(refusal_of_track({}), "there are no flights"));
  std::vector<TrackPoint> rest;
  for (int ms = 0; ms < 1000; ms += 2) rest.push_back({Timestamp{1000 * ms}, {1, 0}});
  CHECK(contains(refusal_of_track(rest), "there are no flights"));

  FlownGame game;
  game.seconds = 10;
  CHECK(contains(refusal_of_track(game.track()), "have a bounce at a rail, of"));

  // Perpendicular bounces only, so that the speed along the rail is undetermined.
  const PuckMotion motion(TableGeometry{});
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.0004);
  std::vector<TrackPoint> straight;
  for (int bounce = 0; bounce < 20; ++bounce) {
    PuckTrack puck{{{1, 0.2}, {0, 1.5}}, {}};
    for (int ms = 0; ms < 500; ms += 4) {
      const TablePoint& at = puck.state.position;
      straight.push_back({Timestamp{1'000'000 * bounce + 1000 * ms},
                          {at.x_m + noise(random), at.y_m + noise(random)}});
      puck = motion.advance(puck, 0.004).track;
    }
  }
  const std::string refusal = refusal_of_track(straight);
  CHECK(contains(refusal, "too few bounces, or too similar ones"));
  CHECK(contains(refusal, "rail_grip"));
}

TEST_CASE("Motion of other objects does not bias the fit") {
  FlownGame game;
  game.seconds = kSeconds;
  game.period_us = kPeriodUs;
  std::vector<TrackPoint> track = game.track();
  // For a tenth of the time the tracker follows a hand.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.01);
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (track[i].t.us / 500'000 % 10 != 0) continue;
    const double at_s = static_cast<double>(track[i].t.us) * 1e-6;
    track[i].position = {1 + 0.3 * std::sin(7 * at_s), 0.3 * std::cos(5 * at_s)};
  }
  const MotionFit fit = fit_motion(find_flights(track, game.world.table), game.world.table);
  check_finds(fit, game.world.physics);
}

}  // namespace
}  // namespace puck
