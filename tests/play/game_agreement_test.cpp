#include <algorithm>
#include <cstdlib>

#include <doctest/doctest.h>

#include "tests/play/play_loop.h"
#include "tests/support/sanitizers.h"

namespace puck {
namespace {

constexpr int kGames = kIsSanitized ? 3 : 5;
constexpr double kSeconds = 40;

struct Disagreement {
  int shots_really = 0;
  int shots = 0;
  int saves = 0;
  int goals = 0;
};

// Summed over games without the sign: what one game has too many does not make good for
// what another has too few.
Disagreement disagreement(const TrackerErrors& errors, double shot_speed_m_s) {
  Disagreement sum;
  for (int seed = 101; seed <= 100 + kGames; ++seed) {
    SimulationParams world;
    world.seed = seed;
    world.game.shot_speed_min_m_s = 0.8 * shot_speed_m_s;
    world.game.shot_speed_max_m_s = shot_speed_m_s;
    PlayLoop loop(world, errors);
    loop.run(kSeconds);
    const GameCounts& truth = loop.truth();
    const GameBelief& belief = loop.belief();
    sum.shots_really += truth.shots;
    sum.shots += std::abs(truth.shots - belief.shots);
    sum.saves += std::abs(truth.saves - belief.saves);
    sum.goals += std::abs(truth.goals_against - belief.goals_against) +
                 std::abs(truth.goals_for - belief.goals_for);
  }
  return sum;
}

TEST_CASE("What the bridge believes of the game is what a referee counts, but for a few shots") {
  const TrackerErrors poor{.sigma_px = 0.3,
                           .sigma_px_s = 30,
                           .losses_per_s = 0.5,
                           .lost_at_hit = 0.3,
                           .strays_per_s = 1,
                           .delay_us = 2'000};
  for (const TrackerErrors& errors : {TrackerErrors{}, poor}) {
    for (const double speed_m_s : {3.0, 8.0}) {
      CAPTURE(errors.sigma_px);
      CAPTURE(speed_m_s);
      const Disagreement d = disagreement(errors, speed_m_s);
      MESSAGE("of ", d.shots_really, " shots: off by ", d.shots, " shots, ", d.saves, " saves, ",
              d.goals, " goals");
      CHECK(d.shots_really >= 10 * kGames);
      // One in twenty; a game that ends with a shot under way may be off by that one.
      CHECK(20 * d.shots <= d.shots_really + 10 * kGames);
      CHECK(20 * d.saves <= d.shots_really + 10 * kGames);
      CHECK(20 * d.goals <= d.shots_really + 10 * kGames);
    }
  }
}

}  // namespace
}  // namespace puck
