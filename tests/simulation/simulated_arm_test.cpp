#include "common/simulation/simulated_arm.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("The arm reaches its target within its limits and does not overshoot") {
  SimulatedArmParams params;
  params.max_speed_m_s = 1;
  params.max_acceleration_m_s2 = 10;
  SimulatedArm arm(params, 0.3);
  arm.set_target(0.25);
  double velocity_before = 0;
  for (int i = 0; i < 1000; ++i) {
    arm.step(0.001);
    CHECK(arm.velocity_m_s() <= 1 + 1e-9);
    CHECK(std::abs(arm.velocity_m_s() - velocity_before) <= 0.01 + 1e-9);
    CHECK(arm.position_m() <= 0.25 + 1e-3);
    velocity_before = arm.velocity_m_s();
  }
  CHECK(arm.position_m() == doctest::Approx(0.25).epsilon(0.01));
}

TEST_CASE("The arm stays on its line and ignores targets that are no numbers") {
  SimulatedArm arm({}, 0.3);
  arm.set_target(7);
  CHECK(arm.target_m() == 0.3);
  arm.set_target(std::numeric_limits<double>::quiet_NaN());
  CHECK(arm.target_m() == 0.3);
  arm.step(2);
  CHECK(arm.position_m() <= 0.3);
  CHECK(arm.position_m() == doctest::Approx(0.3).epsilon(0.01));
}

TEST_CASE("Holding brakes and stays until the next target") {
  SimulatedArm arm({}, 0.3);
  arm.set_target(0.3);
  arm.step(0.1);
  REQUIRE(arm.velocity_m_s() > 0.5);
  arm.hold();
  arm.step(0.2);
  CHECK(arm.velocity_m_s() == doctest::Approx(0));
  const double rest_m = arm.position_m();
  arm.step(1);
  CHECK(arm.position_m() == rest_m);
  arm.set_target(0);
  arm.step(1);
  CHECK(arm.position_m() == doctest::Approx(0).epsilon(0.01));
}

TEST_CASE("An arm that cannot move is refused") {
  SimulatedArmParams params;
  params.max_speed_m_s = 0;
  CHECK_THROWS_AS(SimulatedArm(params, 0.3), std::invalid_argument);
  CHECK_THROWS_AS(SimulatedArm({}, -1), std::invalid_argument);
}

}  // namespace puck
