#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "common/simulation/camera_view.h"
#include "common/simulation/simulated_table.h"
#include "common/simulation/table_game.h"
#include "common/simulation/world_view.h"
#include "tests/simulation/test_worlds.h"

namespace puck {
TEST_CASE("A resting puck lies still for the specified time, is never removed, and is hit") {
  SimulationParams params = small_world(3);
  params.game.rest_probability = 1;
  params.game.rest_min_s = 2.5;  // Longer than the limit for a stuck puck.
  params.game.rest_max_s = 2.5;
  TableGame game(params);
  double still_s = 0;
  double longest_s = 0;
  int rests = 0;
  for (std::int64_t i = 0; i < 40 * kStepsPerSecond; ++i) {
    game.step();
    if (game.puck() && speed_of(*game.puck()) == 0) {
      still_s += PuckPhysics::kStep_s;
      longest_s = std::max(longest_s, still_s);
      continue;
    }
    rests += still_s > 2.4;
    still_s = 0;
  }
  CHECK(rests >= 4);
  CHECK(longest_s > 2.5);
  CHECK(longest_s < 3.6);  // And the swing.
  CHECK(game.counts().shots >= 3);
}

TEST_CASE("The free hand hides the puck from the camera, and leaves again") {
  SimulationParams params = small_world(3);
  params.game.reach_probability = 1;
  params.game.reach_min_s = params.game.reach_max_s = 0.4;
  TableGame game(params);
  const WorldView world(params.table, params.scene, params.sensor_size);
  const CameraView view(params.camera, params.sensor_size);
  int hidden_ms = 0;
  int away_ms = 0;
  int reaches = 0;
  bool was_away = true;
  for (int ms = 0; ms < 15'000; ++ms) {
    for (std::int64_t i = 0; i < kStepsPerSecond / 1000; ++i) game.step();
    const bool away = !game.free_hand().place();
    away_ms += away;
    reaches += was_away && !away;
    was_away = away;
    if (away || !game.puck() || game.puck()->position.x_m < 1.1 || ms % 10 != 0) continue;
    hidden_ms += 10 * (world.visible_share(game, view) < 0.1);
  }
  CHECK(reaches >= 3);
  CHECK(hidden_ms >= 250 * reaches);
  CHECK(away_ms > 3000);
}

TEST_CASE("A second puck keeps its speed, stays on the table, and apart from the first") {
  SimulationParams params = small_world(3);
  params.game.second_puck_speed_m_s = 1.2;
  TableGame game(params);
  REQUIRE(game.second_puck());
  double mean_m_s = 0;
  double nearest_m = 1;
  bool inside = true;
  constexpr int kSeconds = 30;
  for (std::int64_t i = 0; i < kSeconds * kStepsPerSecond; ++i) {
    game.step();
    const DiscState& second = game.second_puck()->state();
    mean_m_s += speed_of(second) / (kSeconds * kStepsPerSecond);
    inside &= params.table.contains(second.position, -0.02);
    if (!game.puck()) continue;
    nearest_m = std::min(nearest_m, std::hypot(second.position.x_m - game.puck()->position.x_m,
                                               second.position.y_m - game.puck()->position.y_m));
  }
  CHECK(mean_m_s == doctest::Approx(1.2).epsilon(0.15));
  CHECK(inside);
  CHECK(nearest_m > 0.06);
  CHECK(game.counts().shots > 5);
  // Truth is that of the other puck.
  SimulatedTable table(params);
  const TablePoint first = table.truth().position;
  CHECK(first.x_m > 0.6 * params.table.length_m);
}

TEST_CASE("Two pucks of the same mass exchange momentum in a bounce") {
  SecondPuck second({}, {}, 1, Random(1, 1));
  const DiscState before = second.state();
  DiscState puck{before.position, {0, 0}};
  puck.position.x_m += 0.05 * before.velocity.x_m_s;
  puck.position.y_m += 0.05 * before.velocity.y_m_s;
  CHECK(second.collide(puck));
  // Head-on at 1 m/s with a restitution of 0.9.
  CHECK(speed_of(puck) == doctest::Approx(0.95));
  CHECK(speed_of(second.state()) == doctest::Approx(0.05));
  CHECK(std::hypot(puck.position.x_m - second.state().position.x_m,
                   puck.position.y_m - second.state().position.y_m) ==
        doctest::Approx(0.065).epsilon(1e-6));
  puck.position.x_m += 0.001;
  puck.position.y_m += 0.001;
  CHECK_FALSE(second.collide(puck));
}

TEST_CASE("Shots have the specified speed, up to 15 m/s") {
  SimulationParams params = small_world(2);
  params.game.shot_speed_min_m_s = 14;
  params.game.shot_speed_max_m_s = 15;
  TableGame game(params);
  double fastest_m_s = 0;
  for (std::int64_t i = 0; i < 20 * kStepsPerSecond; ++i) {
    game.step();
    if (game.puck()) fastest_m_s = std::max(fastest_m_s, speed_of(*game.puck()));
  }
  CHECK(fastest_m_s > 13.5);
  CHECK(fastest_m_s <= 15);
  CHECK(game.counts().shots >= 3);
}

}  // namespace puck
