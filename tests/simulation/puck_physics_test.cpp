#include "common/simulation/puck_physics.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/simulation/test_worlds.h"

namespace puck {
namespace {

PhysicsParams without_damping() {
  PhysicsParams params;
  params.damping_1_s = 0;
  return params;
}

void run(const PuckPhysics& physics, DiscState& puck, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / PuckPhysics::kStep_s));
  for (int i = 0; i < steps; ++i) physics.glide(puck, PuckPhysics::kStep_s);
}

}  // namespace

TEST_CASE("A gliding puck loses its speed exponentially") {
  PhysicsParams params;
  params.damping_1_s = 0.25;
  const PuckPhysics physics({}, params);
  DiscState puck{{0.3, 0}, {1, 0}};
  run(physics, puck, 1);
  CHECK(puck.velocity.x_m_s == doctest::Approx(std::exp(-0.25)).epsilon(1e-4));
  CHECK(puck.position.x_m == doctest::Approx(0.3 + (1 - std::exp(-0.25)) / 0.25).epsilon(1e-4));
}

TEST_CASE("A side rail keeps its shares of the speed") {
  const PuckPhysics physics({}, without_damping());
  DiscState puck{{1, 0.5}, {1, 2}};
  run(physics, puck, 0.1);
  CHECK(puck.velocity.y_m_s == doctest::Approx(-2 * 0.85));
  CHECK(puck.velocity.x_m_s == doctest::Approx(1 * 0.95));
  // It meets the rail at y = 0.5775 after 0.03875 s and comes back for 0.06125 s.
  CHECK(puck.position.y_m == doctest::Approx(0.5775 - 0.06125 * 1.7).epsilon(1e-3));
}

TEST_CASE("An end rail beside the goal reflects, the goal does not") {
  const PuckPhysics physics({}, without_damping());
  DiscState beside{{0.3, 0.4}, {-2, 0}};
  run(physics, beside, 0.2);
  CHECK(beside.velocity.x_m_s == doctest::Approx(2 * 0.85));
  DiscState into_goal{{0.3, 0.1}, {-2, 0}};
  run(physics, into_goal, 0.2);
  CHECK(physics.goal_of(into_goal) == GoalEntered::kRobots);
  DiscState far_end{{1.9, -0.1}, {2, 0}};
  run(physics, far_end, 0.2);
  CHECK(physics.goal_of(far_end) == GoalEntered::kOpponents);
}

TEST_CASE("A goal post deflects the puck to the side of the contact") {
  const PuckPhysics physics({}, without_damping());
  DiscState puck{{0.3, 0.19}, {-2, 0}};
  run(physics, puck, 0.2);
  CHECK(physics.goal_of(puck) == GoalEntered::kNone);
  CHECK(puck.velocity.y_m_s < -0.1);
  CHECK(speed_of(puck) < 2);
}

TEST_CASE("At 15 m/s the puck passes through nothing and gains no energy") {
  PhysicsParams params = without_damping();
  params.rail_normal_keep = 1;
  params.rail_tangential_keep = 1;
  TableGeometry table;
  table.goal_width_m = 0.01;
  const PuckPhysics physics(table, params);
  DiscState puck{{1, 0.1}, {15 * std::cos(0.7), 15 * std::sin(0.7)}};
  for (int i = 0; i < 200'000; ++i) {
    physics.glide(puck, PuckPhysics::kStep_s);
    REQUIRE(std::abs(puck.position.y_m) <= 0.61 - 0.0325 + 1e-9);
    REQUIRE(puck.position.x_m >= 0.0325 - 1e-9);
    REQUIRE(puck.position.x_m <= 2.135 - 0.0325 + 1e-9);
  }
  CHECK(speed_of(puck) == doctest::Approx(15).epsilon(1e-6));
}

TEST_CASE("A mallet at rest sends the puck back with its restitution") {
  const PuckPhysics physics({}, without_damping());
  DiscState puck{{0.5, 0}, {-15, 0}};
  const DiscState mallet{{0.15, 0}, {}};
  bool touched = false;
  for (int i = 0; i < 2000; ++i) {
    touched |= physics.hit(puck, mallet);
    physics.glide(puck, PuckPhysics::kStep_s);
    REQUIRE(puck.position.x_m > 0.15 + 0.0825 - 1e-3);
  }
  CHECK(touched);
  CHECK(puck.velocity.x_m_s == doctest::Approx(15 * 0.8));
}

TEST_CASE("A moving mallet adds its speed") {
  const PuckPhysics physics({}, without_damping());
  DiscState puck{{1, 0}, {0, 0}};
  const DiscState mallet{{1.08, 0}, {-2, 0}};
  REQUIRE(physics.hit(puck, mallet));
  CHECK(puck.velocity.x_m_s == doctest::Approx(-2 * 1.8));
  CHECK(puck.velocity.y_m_s == doctest::Approx(0));
  CHECK(puck.position.x_m == doctest::Approx(1.08 - 0.0825));
}

TEST_CASE("The end of a shot is predicted from its path alone") {
  const PuckPhysics physics({}, {});
  CHECK(physics.would_enter_robots_goal({{1.6, 0}, {-2, 0}}));
  CHECK_FALSE(physics.would_enter_robots_goal({{1.6, 0.4}, {-2, 0}}));
  CHECK_FALSE(physics.would_enter_robots_goal({{1.6, 0}, {2, 0}}));
  CHECK_FALSE(physics.would_enter_robots_goal({{1.6, 0}, {0, 0}}));
  // By the side rail: 0.4775 m up and, slowed to 0.85 across and 0.95 along, 0.5775 m back.
  const double slope = (0.4775 + 0.5775 * 0.95 / 0.85) / 1.5;
  CHECK(physics.would_enter_robots_goal({{1.5, 0.1}, {-2, 2 * slope}}));
}

}  // namespace puck
