#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include <doctest/doctest.h>

#include "tests/support/environment.h"
#include "tests/support/sanitizers.h"
#include "tools/play/closed_loop.h"

namespace puck {
namespace {

// One game is too few for the share that five are held to.
constexpr int kGames = kIsSanitized ? 1 : 5;
constexpr int kShotsPerError = kIsSanitized ? 5 : 20;
constexpr std::int64_t kSeconds = 40;

struct Disagreement {
  int shots_really = 0;
  int shots = 0;
  int saves = 0;
  int goals = 0;
};

// Summed over games by absolute value, so that games do not compensate for one another.
Disagreement disagreement(const PlaySetup& setup) {
  Disagreement sum;
  for (int seed = 101; seed <= 100 + kGames; ++seed) {
    ClosedLoop loop(setup, seed);
    while (loop.now().us < kSeconds * 1'000'000) loop.step();
    const GameCounts& truth = loop.truth().counts;
    const GameBelief& belief = loop.bridge().game();
    sum.shots_really += truth.shots;
    sum.shots += std::abs(truth.shots - belief.shots);
    sum.saves += std::abs(truth.saves - belief.saves);
    sum.goals += std::abs(truth.goals_against - belief.goals_against) +
                 std::abs(truth.goals_for - belief.goals_for);
  }
  return sum;
}

// A tracker without an error.
EstimateErrorParams no_errors() {
  return {.sigma_x_px = 0,
          .sigma_y_px = 0,
          .bias_x_px = 0,
          .bias_y_px = 0,
          .lag_us = 0,
          .reported_sigma_px = 0.1,
          .detection_us = 0,
          .notice_us = 0,
          .loss_share = 0};
}

// One that is worse in every way, behind a network that loses estimates in bursts.
PlaySetup with_poor_tracker(PlaySetup setup) {
  setup.errors.sigma_x_px = setup.errors.sigma_y_px = 0.3;
  setup.errors.correlation_us = 2'000;
  setup.errors.reported_sigma_px = 0.32;
  setup.errors.loss_share = 0.3;
  setup.errors.loss_us = 22'000;
  setup.errors.strays_per_s = 1;
  setup.link.latency_us = 2'000;
  setup.link.loss_percent = 2;
  setup.link.burst_us = 40'000;
  return setup;
}

TEST_CASE("What the bridge believes of the game is what a referee counts, but for a few shots") {
  PlaySetup ideal = default_setup(source_folder() / "config/calibration");
  ideal.errors = no_errors();
  const PlaySetup poor = with_poor_tracker(ideal);
  for (PlaySetup setup : {ideal, poor}) {
    for (const double speed_m_s : {3.0, 8.0}) {
      CAPTURE(setup.errors.sigma_x_px);
      CAPTURE(speed_m_s);
      setup.world.game.shot_speed_min_m_s = 0.8 * speed_m_s;
      setup.world.game.shot_speed_max_m_s = speed_m_s;
      const Disagreement d = disagreement(setup);
      MESSAGE("of ", d.shots_really, " shots: off by ", d.shots, " shots, ", d.saves, " saves, ",
              d.goals, " goals");
      CHECK(d.shots_really >= 10 * kGames);
      // A game that ends with a shot under way may be off by that one.
      const int most = (d.shots_really + 10 * kGames) / kShotsPerError;
      CHECK(d.shots <= most);
      CHECK(d.saves <= most);
      CHECK(d.goals <= most);
    }
  }
}

}  // namespace
}  // namespace puck
