#include "common/control/joint_guard.h"

#include <array>
#include <limits>

#include <doctest/doctest.h>

#include "common/motion/jerk_limited_motion.h"

namespace puck {
namespace {

constexpr MotionLimits kLimits{-30, 30, 100, 1000, 20'000};

JointAngles angles(double first, double second) {
  return JointAngles(std::array<double, 2>{first, second});
}

class GuardedJoints {
 public:
  GuardedJoints() { guard.restart(angles(0, 0)); }
  bool send(double deg, double dt_s = 0.002) { return guard.allows(angles(0, deg), dt_s); }

  JointGuard guard{{kLimits, kLimits}};
};

TEST_CASE("A motion within the limits passes at even and uneven times, up to its limits") {
  for (const bool even : {true, false}) {
    GuardedJoints joints;
    JerkLimitedMotion motion(kLimits, 0);
    for (int i = 0; i < 3000; ++i) {
      if (i % 100 == 0) motion.set_target(i % 200 == 0 ? 30 : -30);
      const double dt_s = even ? 0.002 : 0.0005 + 0.0003 * (i * 7 % 11);
      motion.step(dt_s);
      REQUIRE(joints.send(motion.state().position, dt_s));
    }
    CHECK(joints.guard.refusal().empty());
  }
}

TEST_CASE("Each limit of each joint is checked separately") {
  GuardedJoints joints;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK(!joints.send(bad));
    CHECK(joints.guard.refusal() == "a set-point of joint 1 was not finite: not sent");
  }
  CHECK(!joints.send(30.1));
  CHECK(joints.guard.refusal().find("outside its limits") != std::string::npos);
  CHECK(!joints.send(0.21));
  CHECK(joints.guard.refusal().find("too fast") != std::string::npos);
  CHECK(!joints.send(0.005));
  CHECK(joints.guard.refusal().find("acceleration limit") != std::string::npos);
  // 20 000 deg/s³ move it by 0.16 µdeg in 2 ms.
  CHECK(!joints.send(0.00017));
  CHECK(joints.guard.refusal().find("jerk limit") != std::string::npos);
  CHECK(joints.send(0.00016));
  CHECK(!joints.guard.allows(JointAngles(std::array<double, 1>{0}), 0.002));
  CHECK(!joints.send(0.00016, 0));
  CHECK(!joints.send(0.00016, -1));
  // Refused set-points do not count: a rest follows the last accepted one.
  CHECK(joints.send(0.00016 + 0.00032));
}

TEST_CASE("A motion a thousandth beyond a limit is refused") {
  for (double MotionLimits::*limit :
       {&MotionLimits::velocity, &MotionLimits::acceleration, &MotionLimits::jerk}) {
    MotionLimits beyond = kLimits;
    beyond.*limit *= 1.001;
    JerkLimitedMotion motion(beyond, 0);
    GuardedJoints joints;
    bool refused = false;
    motion.set_target(30);
    for (int i = 0; i < 1000 && !refused; ++i) {
      motion.step(0.002);
      refused = !joints.send(motion.state().position);
    }
    CHECK(refused);
  }
}

}  // namespace
}  // namespace puck
