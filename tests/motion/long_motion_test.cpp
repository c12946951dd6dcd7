#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "common/motion/jerk_limited_motion.h"
#include "tests/support/sanitizers.h"

namespace puck {
namespace {

// Rounding of places of about 1, thrice differenced.
constexpr double kRounding = 1e-14;

// Checks each step by differences of its own.
class Judge {
 public:
  Judge(const MotionLimits& limits, double position, double dt_s)
      : limits_(limits), dt_s_(dt_s), last_{position, 0, 0} {}

  void see(const MotionState& state) {
    const double rounding = kRounding * std::max(1.0, limits_.highest);
    const double velocity = (state.position - last_.position) / dt_s_;
    const double acceleration = (velocity - last_.velocity) / dt_s_;
    const double jerk = (acceleration - last_.acceleration) / dt_s_;
    const auto exceeds = [](double value, double limit, double slack) {
      return !(std::abs(value) <= limit * (1 + 1e-9) + slack);
    };
    if (exceeds(velocity, limits_.velocity, rounding / dt_s_) ||
        exceeds(acceleration, limits_.acceleration, 4 * rounding / (dt_s_ * dt_s_)) ||
        exceeds(jerk, limits_.jerk, 8 * rounding / (dt_s_ * dt_s_ * dt_s_)) ||
        state.position < limits_.lowest - rounding || state.position > limits_.highest + rounding) {
      ++exceeded_;
    }
    fastest_ = std::max(fastest_, std::abs(velocity));
    last_ = {state.position, velocity, acceleration};
  }

  long exceeded() const { return exceeded_; }
  double fastest() const { return fastest_; }

 private:
  MotionLimits limits_;
  double dt_s_;
  MotionState last_;
  long exceeded_ = 0;
  double fastest_ = 0;
};

TEST_CASE("A cruise of minutes keeps its limits to the last step, and reaches its target in time") {
  // 0.6 m at 1 mm/s; 90 deg at 0.1 deg/s.
  for (const MotionLimits& limits :
       {MotionLimits{-0.3, 0.3, 0.001, 20, 2000}, MotionLimits{0, 90, 0.1, 0.5, 5}}) {
    const double length = limits.highest - limits.lowest;
    for (const double dt_s : {0.001, 0.002, 0.0013}) {
      CAPTURE(length);
      CAPTURE(dt_s);
      JerkLimitedMotion motion(limits, limits.lowest);
      Judge judge(limits, limits.lowest, dt_s);
      REQUIRE(motion.set_target(limits.highest));
      const double planned_s = motion.time_left_s();
      CHECK(planned_s > length / limits.velocity);
      double passed_s = 0;
      while (!motion.is_at_rest() && passed_s < 2 * planned_s) {
        motion.step(dt_s);
        passed_s += dt_s;
        judge.see(motion.state());
      }
      for (int i = 0; i < 10; ++i) {
        motion.step(dt_s);
        judge.see(motion.state());
      }
      CHECK(judge.exceeded() == 0);
      CHECK(judge.fastest() == doctest::Approx(limits.velocity));
      CHECK(motion.state().position == limits.highest);
      CHECK(passed_s == doctest::Approx(planned_s).epsilon(1e-5));
    }
  }
}

TEST_CASE("Hours of following a target keep the limits, and end exactly at the target") {
  constexpr MotionLimits kArm{-0.3, 0.3, 1.5, 20, 2000};
  constexpr double kDtS = 0.002;
  constexpr long kSteps = (kIsSanitized ? 60L : 2 * 3600L) * 500;
  JerkLimitedMotion motion(kArm, 0);
  Judge judge(kArm, 0, kDtS);
  for (long i = 0; i < kSteps; ++i) {
    // A puck that sways, now and then too fast for the arm, and that leaps every seven seconds.
    const double t = static_cast<double>(i) * kDtS;
    const double leap = std::fmod(t, 14) < 7 ? 0.1 : -0.1;
    REQUIRE(motion.set_target(leap + 0.25 * std::sin(3 * t) * std::sin(0.1 * t)));
    motion.step(kDtS);
    judge.see(motion.state());
  }
  CHECK(judge.exceeded() == 0);
  CHECK(judge.fastest() > 1.4);
  REQUIRE(motion.set_target(0.123));
  for (int i = 0; i < 500; ++i) {
    motion.step(kDtS);
    judge.see(motion.state());
  }
  CHECK(judge.exceeded() == 0);
  CHECK(motion.state().position == 0.123);
  CHECK(motion.state().velocity == 0);
}

}  // namespace
}  // namespace puck
