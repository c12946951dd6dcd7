#include "common/simulation/simulated_arm.h"

#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>

namespace puck {

// tests/motion checks the limits at every step.

TEST_CASE("The arm reaches its target in the time that its limits allow, and stays") {
  SimulatedArmParams params;
  params.max_speed_m_s = 1;
  params.max_acceleration_m_s2 = 10;
  params.max_jerk_m_s3 = 1000;
  SimulatedArm arm(params, 0.3);
  arm.set_target(0.25);
  // 0.1 s up to 1 m/s and down again, 10 ms more for either acceleration to build up, and 140 mm at
  // 1 m/s.
  constexpr double kTimeS = 0.11 + 0.11 + (0.25 - 0.11) / 1;
  arm.step(kTimeS - 0.002);
  CHECK(arm.position_m() < 0.25);
  CHECK(arm.velocity_m_s() > 0);
  arm.step(0.003);
  CHECK(arm.position_m() == 0.25);
  CHECK(arm.velocity_m_s() == 0);
}

TEST_CASE("The arm stays on its line and ignores targets that are not finite") {
  SimulatedArm arm({}, 0.3);
  arm.set_target(7);
  CHECK(arm.target_m() == 0.3);
  arm.set_target(std::numeric_limits<double>::quiet_NaN());
  CHECK(arm.target_m() == 0.3);
  arm.step(2);
  CHECK(arm.position_m() == 0.3);
}

TEST_CASE("Holding brakes and stays until the next target") {
  SimulatedArm arm({}, 0.3);
  arm.set_target(0.3);
  arm.step(0.1);
  REQUIRE(arm.velocity_m_s() > 0.5);
  arm.hold();
  arm.step(0.2);
  CHECK(arm.velocity_m_s() == 0);
  const double rest_m = arm.position_m();
  arm.step(1);
  CHECK(arm.position_m() == rest_m);
  arm.set_target(0);
  arm.step(1);
  CHECK(arm.position_m() == 0);
}

TEST_CASE("An immobile arm is refused by its key") {
  SimulatedArmParams params;
  params.max_jerk_m_s3 = 0;
  CHECK_THROWS_WITH_AS(SimulatedArm(params, 0.3),
                       "arm.max_jerk_m_s3 must be more than 0, got 0.000000",
                       std::invalid_argument);
  CHECK_THROWS_AS(SimulatedArm({}, -1), std::invalid_argument);
}

}  // namespace puck
