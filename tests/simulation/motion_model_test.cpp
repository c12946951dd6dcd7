#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "common/simulation/puck_physics.h"
#include "common/simulation/random.h"
#include "common/table/puck_motion.h"

namespace puck {
namespace {

struct Comparison {
  std::vector<double> off_mm;  // sorted
  int disputed_goals = 0;
};

// Moves pucks from random places in a box for 0.6 s, in the simulated world and in the model with
// the world's constants.
Comparison compare(TablePoint lowest, TablePoint highest, double slowest, double fastest) {
  const TableGeometry table;
  const PhysicsParams world;
  const PuckPhysics physics(table, world);
  const PuckMotion model(
      table, {world.damping_1_s, world.rail_normal_keep, world.rail_tangential_keep, 0, 0});
  Random random(3, 1);
  Comparison comparison;
  for (int i = 0; i < 400; ++i) {
    const double angle = random.uniform(0, 6.2832);
    const double speed = random.uniform(slowest, fastest);
    DiscState puck{
        {random.uniform(lowest.x_m, highest.x_m), random.uniform(lowest.y_m, highest.y_m)},
        {speed * std::cos(angle), speed * std::sin(angle)}};
    const PuckMotion::Advanced end = model.advance({{puck.position, puck.velocity}, {}}, 0.6);
    bool in_goal = false;
    for (double t_s = 0; t_s < 0.6 && !in_goal; t_s += PuckPhysics::kStep_s) {
      physics.glide(puck, PuckPhysics::kStep_s);
      in_goal = physics.goal_of(puck) != GoalEntered::kNone;
    }
    if (in_goal != end.in_goal) ++comparison.disputed_goals;
    if (in_goal || end.in_goal) continue;
    comparison.off_mm.push_back(1e3 * std::hypot(puck.position.x_m - end.track.state.position.x_m,
                                                 puck.position.y_m - end.track.state.position.y_m));
  }
  std::sort(comparison.off_mm.begin(), comparison.off_mm.end());
  return comparison;
}

TEST_CASE("The motion model follows the simulated puck's path, rails and corners included") {
  const Comparison all = compare({0.1, -0.5}, {2.0, 0.5}, 0.5, 5);
  CHECK(all.off_mm[all.off_mm.size() / 2] < 0.5);
  CHECK(all.off_mm[all.off_mm.size() * 95 / 100] < 3);
  CHECK(all.disputed_goals <= 2);
  const Comparison corner = compare({1.9, 0.4}, {2.09, 0.57}, 1, 5);
  CHECK(corner.off_mm[corner.off_mm.size() * 95 / 100] < 3);
}

TEST_CASE("The motion model includes the goals' posts") {
  // Just before the posts of both goals; contact with a point magnifies every difference.
  for (const double x_m : {0.06, 2.075}) {
    const Comparison posts = compare({x_m - 0.02, 0.14}, {x_m + 0.02, 0.23}, 1, 3);
    CHECK(posts.off_mm[posts.off_mm.size() / 2] < 1);
    CHECK(posts.off_mm[posts.off_mm.size() * 9 / 10] < 10);
    CHECK(posts.disputed_goals <= 4);
  }
}

}  // namespace
}  // namespace puck
