#include "common/motion/joint_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "common/motion/simulated_joints.h"

namespace puck {
namespace {

using Deg = std::array<double, 7>;

// A joint that is 10 + 100 y: evenly spaced control points reproduce a line.
JointTableParams straight() {
  LineJoint joint{"straight", {-90, 90, 100, 1000, 10'000}, {}};
  for (int i = -1; i <= 4; ++i) joint.control_deg.push_back(10 + 100 * (-0.3 + 0.2 * i));
  return {-0.3, 0.3, {joint}};
}

std::string refusal_of(const JointTableParams& params) {
  try {
    const JointTable table(params);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST_CASE("A joint linear along the line is interpolated exactly, clamped to the line's ends") {
  const JointTable table(straight());
  std::array<double, 1> deg{};
  for (const double y_m : {-0.3, -0.123, 0.0, 0.1, 0.3}) {
    table.at(y_m, deg);
    CHECK(deg[0] == doctest::Approx(10 + 100 * y_m));
  }
  table.at(7, deg);
  CHECK(deg[0] == doctest::Approx(40));
  table.at(-7, deg);
  CHECK(deg[0] == doctest::Approx(-20));
}

TEST_CASE(
    "Joints and their first two derivatives are continuous, and monotone joints stay monotone") {
  const JointTable table(simulated_joints());
  constexpr double kStepM = 1e-4;
  Deg before{}, deg{}, slope{}, slope_before{}, bend_before{};
  table.at(-0.3, before);
  for (int i = 1; i <= 6000; ++i) {
    table.at(-0.3 + i * kStepM, deg);
    for (std::size_t k = 0; k < 7; ++k) {
      slope[k] = (deg[k] - before[k]) / kStepM;
      const double bend = (slope[k] - slope_before[k]) / kStepM;
      // A third derivative of at most 1000 deg/m³ and the differences' rounding.
      if (i > 2) REQUIRE(std::abs(bend - bend_before[k]) < 1000 * kStepM + 1e-5);
      if (i > 1 && k != 5) REQUIRE(slope[k] * slope_before[k] > 0);
      bend_before[k] = bend;
    }
    before = deg;
    slope_before = slope;
  }
  CHECK(!table.is_monotone(5));
  CHECK(table.is_monotone(0));
}

TEST_CASE("The place on the line and the distance from it follow from the joints") {
  const JointTable table(simulated_joints());
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-0.3, 0.3);
  for (int i = 0; i < 200; ++i) {
    const double y_m = place(random);
    Deg deg{};
    table.at(y_m, deg);
    const LinePlace found = table.place_of(deg);
    REQUIRE(found.y_m == doctest::Approx(y_m).epsilon(1e-6));
    REQUIRE(found.off_deg < 1e-4);
    REQUIRE(table.place_near(std::clamp(y_m + 0.02, -0.3, 0.3), deg).y_m ==
            doctest::Approx(y_m).epsilon(1e-6));
    deg[3] += 5;
    REQUIRE(table.place_of(deg).off_deg > 2);
  }
}

TEST_CASE("A motion within the line's limits keeps every joint's limits") {
  const JointTable table(simulated_joints());
  MotionLimits line = table.line_limits({-0.3, 0.3, 1e3, 1e6, 1e9});
  CHECK(line.velocity > 1.5);
  CHECK(line.acceleration > 20);
  CHECK(line.jerk > 2000);
  // Desired limits that fit are unchanged.
  const MotionLimits wanted = table.line_limits({-0.3, 0.3, 1.5, 20, 2000});
  CHECK(wanted.velocity == 1.5);
  CHECK(wanted.acceleration == 20);
  CHECK(wanted.jerk == 2000);

  JerkLimitedMotion motion(line, 0);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(-0.3, 0.3);
  constexpr double kDtS = 0.001;
  Deg before{}, velocity{}, acceleration{};
  table.at(0, before);
  double nearest = 0;  // largest share of a jerk limit
  for (int i = 0; i < 50'000; ++i) {
    if (i % 40 == 0) motion.set_target(place(random));
    motion.step(kDtS);
    Deg deg{};
    table.at(motion.state().position, deg);
    for (std::size_t k = 0; k < 7; ++k) {
      const MotionLimits& limits = table.limits(k);
      const double v = (deg[k] - before[k]) / kDtS;
      const double a = (v - velocity[k]) / kDtS;
      const double j = (a - acceleration[k]) / kDtS;
      REQUIRE(deg[k] >= limits.lowest);
      REQUIRE(deg[k] <= limits.highest);
      REQUIRE(std::abs(v) <= limits.velocity);
      REQUIRE(std::abs(a) <= limits.acceleration);
      REQUIRE(std::abs(j) <= limits.jerk);
      nearest = std::max(nearest, std::abs(j) / limits.jerk);
      velocity[k] = v;
      acceleration[k] = a;
    }
    before = deg;
  }
  CHECK(nearest > 0.5);
}

TEST_CASE("An impossible table is refused with the reason") {
  CHECK(refusal_of(straight()).empty());
  JointTableParams params = straight();
  params.to_m = params.from_m;
  CHECK(refusal_of(params).find("from_m and to_m must be finite") != std::string::npos);
  CHECK(refusal_of({-0.3, 0.3, {}}).find("needs 1 to 16 joints") != std::string::npos);
  params = straight();
  params.joints[0].control_deg.resize(3);
  CHECK(refusal_of(params).find("4 to 1000 control points") != std::string::npos);
  params = straight();
  params.joints.push_back(params.joints[0]);
  params.joints[1].control_deg.pop_back();
  CHECK(refusal_of(params).find("joint_1 has 5 control points") != std::string::npos);
  params = straight();
  params.joints[0].control_deg[2] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal_of(params).find("leaves its limits") != std::string::npos);
  params.joints[0].control_deg[2] = 400;
  CHECK(refusal_of(params).find("leaves its limits") != std::string::npos);
  params = straight();
  params.joints[0].limits.jerk = 0;
  CHECK(refusal_of(params).find("a velocity, acceleration and jerk") != std::string::npos);
  params = straight();
  params.joints[0].control_deg = {0, 10, 20, 20, 10, 0};
  CHECK(refusal_of(params).find("no joint grows or falls") != std::string::npos);
}

}  // namespace
}  // namespace puck
