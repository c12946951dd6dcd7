#include "common/simulation/puck_serve.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/simulation/camera_view.h"
#include "common/simulation/table_game.h"
#include "common/simulation/world_view.h"
#include "tests/simulation/test_worlds.h"

namespace puck {
namespace {

double distance_m(TablePoint a, TablePoint b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

}  // namespace

TEST_CASE("A served puck is pushed from one place to another and left there at rest") {
  const TablePoint from{2.2, 0};
  const TablePoint halfway{1.85, 0.1};
  const TablePoint to{1.5, 0.2};
  PuckServe serve(from, halfway, to);
  constexpr double kStep_s = 1e-3;
  DiscState puck{from, {}};
  double fastest_m_s = 0;
  int steps = 0;
  while (serve.is_under_way()) {
    const DiscState next = serve.step(kStep_s);
    const double vx_m_s = (next.position.x_m - puck.position.x_m) / kStep_s;
    CHECK(std::abs(vx_m_s - next.velocity.x_m_s) < 0.02);
    fastest_m_s = std::max(fastest_m_s, std::abs(vx_m_s));
    puck = next;
    ++steps;
  }
  CHECK(std::abs(steps - 500) <= 1);
  CHECK(puck.position.x_m == doctest::Approx(to.x_m));
  CHECK(puck.position.y_m == doctest::Approx(to.y_m));
  CHECK(std::hypot(puck.velocity.x_m_s, puck.velocity.y_m_s) < 1e-6);
  // A quarter of a sine is π/2 times as fast at its start as on average.
  CHECK(fastest_m_s == doctest::Approx(0.7 / 0.5 * 1.5708).epsilon(0.01));
}

TEST_CASE("A served puck goes around obstacles on the straight way, at the specified speed") {
  PuckServe serve({2.2, 0}, {1.9, 0.3}, {1.5, 0.1});
  constexpr double kStep_s = 1e-3;
  DiscState puck = serve.step(0);
  double farthest_m = 0;
  while (serve.is_under_way()) {
    const DiscState next = serve.step(kStep_s);
    const double vx_m_s = (next.position.x_m - puck.position.x_m) / kStep_s;
    const double vy_m_s = (next.position.y_m - puck.position.y_m) / kStep_s;
    CHECK(std::hypot(vx_m_s - next.velocity.x_m_s, vy_m_s - next.velocity.y_m_s) < 0.03);
    puck = next;
    farthest_m = std::max(farthest_m, puck.position.y_m);
  }
  CHECK(farthest_m > 0.15);
  CHECK(puck.position.y_m == doctest::Approx(0.1));
}

TEST_CASE("A served puck passes the opponent's waiting mallet without contact") {
  struct World {
    std::string name;
    SimulationParams params;
  };
  std::vector<World> worlds(4, {"plain", {}});
  worlds[1].name = "served at once after hard shots";
  worlds[1].params.game.serve_after_s = 0;
  worlds[1].params.game.shot_speed_min_m_s = 8;
  worlds[1].params.game.shot_speed_max_m_s = 15;
  worlds[2].name = "large mallets";
  worlds[2].params.table.mallet_radius_m = 0.1;
  worlds[3].name = "a short table";
  worlds[3].params.table.length_m = 1.05;
  worlds[3].params.table.robot_line_x_m = 0.1;
  for (World& world : worlds) {
    CAPTURE(world.name);
    int serves = 0;
    double nearest_m = 1;
    double farthest_from_home_m = 0;
    for (std::int64_t seed = 1; seed <= 5; ++seed) {
      SimulationParams& params = world.params;
      params.seed = seed;
      params.table.goal_width_m = 1;  // Many goals, so many serves.
      params.game.served_at_start = true;
      TableGame game(params);
      const TablePoint home = game.opponent_mallet().position;
      double since_serve_s = 0;
      for (int step = 0; step < 20 * kStepsPerSecond; ++step) {
        const bool was_there = game.puck().has_value();
        game.step();
        const auto& puck = game.puck();
        if (!puck) continue;
        since_serve_s = was_there ? since_serve_s + PuckPhysics::kStep_s : 0;
        serves += was_there ? 0 : 1;
        // Until it is left at rest.
        if (since_serve_s > 0.49) continue;
        const TablePoint mallet = game.opponent_mallet().position;
        nearest_m = std::min(nearest_m, distance_m(puck->position, mallet));
        farthest_from_home_m = std::max(farthest_from_home_m, distance_m(mallet, home));
      }
    }
    CHECK(serves > 5);
    const TableGeometry& table = world.params.table;
    CHECK(nearest_m > table.puck_radius_m + table.mallet_radius_m + 0.005);
    CHECK(farthest_from_home_m < 0.011);
  }
}

TEST_CASE("Nothing appears or vanishes suddenly, except a puck that falls into a goal") {
  SimulationParams params = small_world();
  params.table.goal_width_m = 1;
  const WorldView world(params.table, params.scene, params.sensor_size);
  const CameraView view(params.camera, params.sensor_size);
  TableGame game(params);
  std::optional<double> before;
  double most = 0;
  int serves = 0;
  for (int ms = 0; ms < 20'000; ++ms) {
    for (int step = 0; step < kStepsPerSecond / 1000; ++step) game.step();
    std::optional<double> now;
    if (game.puck()) now = world.visible_share(game, view);
    if (now && before) most = std::max(most, std::abs(*now - *before));
    // A returning puck is behind the mallet at first.
    if (now && !before && ms > 0) {
      ++serves;
      CHECK(*now < 0.25);
    }
    before = now;
  }
  CHECK(serves > 0);
  CHECK(most < 0.3);
}

TEST_CASE(
    "A game that begins with a serve has its first puck come from behind the opponent's mallet") {
  SimulationParams params;
  CHECK(TableGame(params).puck()->position.x_m < 0.8 * params.table.length_m);
  params.game.served_at_start = true;
  TableGame game(params);
  CHECK(game.puck()->position.x_m > game.opponent_mallet().position.x_m);
  for (int step = 0; step < 20'000; ++step) game.step();
  CHECK(game.puck()->position.x_m < 0.8 * params.table.length_m);
}

}  // namespace puck
