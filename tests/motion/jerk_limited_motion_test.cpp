#include "common/motion/jerk_limited_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/support/sanitizers.h"

namespace puck {
namespace {

constexpr MotionLimits kArm{-0.3, 0.3, 1.5, 20, 2000};

constexpr int kTargets = kIsSanitized ? 10'000 : 1'000'000;

// The shortest time for a move from rest to rest within the limits, from the textbook's four cases.
double shortest_s(double distance, const MotionLimits& limits) {
  const double v = limits.velocity;
  const double a = limits.acceleration;
  const double j = limits.jerk;
  const bool meets_acceleration = v * j >= a * a;
  const double to_velocity_s = meets_acceleration ? v / a + a / j : 2 * std::sqrt(v / j);
  if (distance >= v * to_velocity_s) return to_velocity_s + distance / v;
  if (distance >= 2 * a * a * a / (j * j)) {
    return a / j + std::sqrt(a * a / (j * j) + 4 * distance / a);
  }
  return 4 * std::cbrt(distance / (2 * j));
}

// The differences of evenly sampled positions, as a joint's motion.
class Differences {
 public:
  Differences(double position, double dt_s) : dt_s_(dt_s), position_(position) {}

  void see(double position) {
    const double velocity = (position - position_) / dt_s_;
    const double acceleration = (velocity - velocity_) / dt_s_;
    jerk_ = (acceleration - acceleration_) / dt_s_;
    position_ = position;
    velocity_ = velocity;
    acceleration_ = acceleration;
    most_.velocity = std::max(most_.velocity, std::abs(velocity_));
    most_.acceleration = std::max(most_.acceleration, std::abs(acceleration_));
    most_.jerk = std::max(most_.jerk, std::abs(jerk_));
    most_.highest = std::max(most_.highest, std::abs(position_));
  }
  const MotionLimits& most() const { return most_; }

 private:
  double dt_s_;
  double position_;
  double velocity_ = 0;
  double acceleration_ = 0;
  double jerk_ = 0;
  MotionLimits most_;
};

void check_within(const MotionLimits& most, const MotionLimits& limits, double dt_s) {
  // Positions are sums of a few numbers rounded to 1e-16; their third differences are divided by
  // dt³.
  const double rounding = 1e-14;
  CHECK(most.highest <= limits.highest + rounding);
  CHECK(most.velocity <= limits.velocity * (1 + 1e-12) + rounding / dt_s);
  CHECK(most.acceleration <= limits.acceleration * (1 + 1e-12) + rounding / (dt_s * dt_s));
  CHECK(most.jerk <= limits.jerk * (1 + 1e-9) + rounding / (dt_s * dt_s * dt_s));
}

TEST_CASE("A move from rest to rest takes the shortest time within its limits") {
  for (const MotionLimits& limits :
       {kArm, MotionLimits{-0.3, 0.3, 0.3, 2, 20}, MotionLimits{-0.3, 0.3, 1.5, 100, 500}}) {
    for (const double distance : {1e-6, 0.001, 0.02, 0.1, 0.3, 0.6}) {
      JerkLimitedMotion motion(limits, -0.3);
      CHECK(motion.set_target(-0.3 + distance));
      const double shortest = shortest_s(distance, limits);
      CHECK(motion.time_left_s() / shortest == doctest::Approx(1).epsilon(1e-9));
      if (distance >= 0.1 && limits.velocity == kArm.velocity && limits.jerk == kArm.jerk) {
        MESSAGE(distance, " m: ", 1e3 * motion.time_left_s(), " ms, shortest ", 1e3 * shortest);
      }
    }
  }
}

TEST_CASE("It rests exactly at its target, at the predicted time, and stays without a tremor") {
  JerkLimitedMotion motion(kArm, 0);
  motion.set_target(0.123);
  const int steps = static_cast<int>(std::ceil(motion.time_left_s() / 0.001));
  for (int i = 0; i < steps - 1; ++i) motion.step(0.001);
  CHECK(!motion.is_at_rest());
  CHECK(std::abs(motion.state().position - 0.123) < 1e-5);
  for (int i = 0; i < 1000; ++i) {
    motion.step(0.001);
    motion.set_target(0.123);
    REQUIRE(motion.is_at_rest());
    REQUIRE(motion.state().position == 0.123);
    REQUIRE(motion.state().velocity == 0);
    REQUIRE(motion.state().acceleration == 0);
  }
}

TEST_CASE("A target that is not finite is refused, one beyond an end is clamped to it") {
  JerkLimitedMotion motion(kArm, 0);
  motion.set_target(0.2);
  for (const double none :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    CHECK(!motion.set_target(none));
    CHECK(!motion.rest_at(none));
    motion.step(none);
    CHECK(motion.target() == 0.2);
    CHECK(motion.state().position == 0);
  }
  CHECK(motion.set_target(1e300));
  CHECK(motion.target() == 0.3);
  CHECK(motion.rest_at(-7));
  CHECK(motion.state().position == -0.3);
  CHECK(JerkLimitedMotion(kArm, 7).state().position == 0.3);
}

TEST_CASE("Invalid limits are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    for (double MotionLimits::*limit :
         {&MotionLimits::velocity, &MotionLimits::acceleration, &MotionLimits::jerk}) {
      MotionLimits limits = kArm;
      limits.*limit = bad;
      CHECK_THROWS_AS(JerkLimitedMotion(limits, 0), std::invalid_argument);
    }
  }
  CHECK_THROWS_AS(JerkLimitedMotion({0.3, 0.3, 1, 1, 1}, 0), std::invalid_argument);
  CHECK_THROWS_AS(JerkLimitedMotion({nan, 0.3, 1, 1, 1}, 0), std::invalid_argument);
  CHECK_THROWS_AS(JerkLimitedMotion(kArm, nan), std::invalid_argument);
}

TEST_CASE("Holding at full speed takes V/A + A/J, from any place") {
  JerkLimitedMotion motion(kArm, -0.3);
  motion.set_target(0.3);
  while (motion.state().velocity < 1.5) motion.step(0.001);
  motion.step(0.02);
  CHECK(motion.state().acceleration == 0);
  const double before = motion.state().position;
  motion.hold();
  const double brake_s = 1.5 / 20 + 20.0 / 2000;
  CHECK(motion.time_left_s() == doctest::Approx(brake_s));
  CHECK(motion.target() == doctest::Approx(before + 1.5 / 2 * brake_s));
  for (int i = 0; i < 90; ++i) {
    motion.hold();
    motion.step(0.001);
  }
  CHECK(motion.is_at_rest());
  CHECK(motion.state().position == motion.target());
}

TEST_CASE("Repeating a target during the motion changes nothing but rounding") {
  // The principle of optimality: the rest of a shortest motion is a shortest motion. Planned anew
  // from any state on it, it arrives at the same time.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-0.3, 0.3);
  std::uniform_real_distribution<double> pause_s(0.001, 0.2);
  for (int i = 0; i < 2000; ++i) {
    JerkLimitedMotion motion(kArm, place(random));
    // Any state at all: on the way to somewhere else, or braking.
    motion.set_target(place(random));
    motion.step(pause_s(random));
    if (i % 3 == 0) motion.hold();
    motion.step(pause_s(random) / 5);
    const double target = place(random);
    motion.set_target(target);
    JerkLimitedMotion again = motion;
    const double step_s = pause_s(random);
    motion.step(step_s);
    again.step(step_s);
    again.hold();
    again.set_target(target);
    REQUIRE(again.time_left_s() == doctest::Approx(motion.time_left_s()).epsilon(1e-6));
  }
}

TEST_CASE("No other motion with the jerk at its limits arrives sooner") {
  // Random switching times: every motion that ends at rest at the target or beyond, within the
  // limits, takes at least as long as the planned motion to its end.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-0.2, 0.2);
  std::uniform_real_distribution<double> duration_s(0, 0.012);
  int tried = 0;
  for (int i = 0; i < 20'000; ++i) {
    JerkLimitedMotion motion(kArm, place(random));
    motion.set_target(place(random));
    motion.step(10 * duration_s(random));
    const JerkLimitedMotion start = motion;
    // Jerks +, −, +, … of random lengths, then the quickest way to rest.
    double jerk = i % 2 == 0 ? 2000 : -2000;
    MotionState s = start.state();
    double took_s = 0;
    bool within = true;
    for (int k = 0; k < 2; ++k, jerk = -jerk) {
      const double t = duration_s(random);
      s = {s.position + t * (s.velocity + t * (s.acceleration / 2 + t * jerk / 6)),
           s.velocity + t * (s.acceleration + t * jerk / 2), s.acceleration + t * jerk};
      took_s += t;
      within = within && std::abs(s.acceleration) <= 20 && std::abs(s.velocity) <= 1.2;
    }
    if (!within) continue;
    // The way to rest by the textbook, independent of the class.
    const double free = s.velocity + s.acceleration * std::abs(s.acceleration) / 4000;
    const double side = free < 0 ? -1 : 1;
    const double v = side * s.velocity;
    const double a = side * s.acceleration;
    const double peak = std::sqrt(2000 * (v + a * a / 4000));
    if (peak > 20) continue;
    const double t1 = (a + peak) / 2000;
    const double t2 = peak / 2000;
    const double v1 = v + a * t1 - 1000 * t1 * t1;
    const double end = s.position + side * (v * t1 + a * t1 * t1 / 2 - 2000 * t1 * t1 * t1 / 6 +
                                            v1 * t2 - peak * t2 * t2 / 2 + 2000 * t2 * t2 * t2 / 6);
    took_s += t1 + t2;
    if (std::abs(end) > 0.3) continue;
    JerkLimitedMotion planned = start;
    planned.set_target(end);
    REQUIRE(planned.time_left_s() <= took_s + 1e-7);
    ++tried;
  }
  CHECK(tried > 2000);
}

TEST_CASE("A hold in the last phase of braking continues braking, in either direction") {
  // In exact numbers: 1/8 s before its end the motion brakes by 1 at a speed of 1/16, and the
  // braking is reduced to zero.
  constexpr MotionLimits kExact{-4, 4, 0.5, 1024, 8};
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    JerkLimitedMotion motion(kExact, 0);
    motion.set_target(side);
    motion.step(motion.time_left_s() - 0.125);
    REQUIRE(motion.state().velocity == side * 0.0625);
    REQUIRE(motion.state().acceleration == -side);
    motion.hold();
    CHECK(motion.time_left_s() == doctest::Approx(0.125));
    motion.step(0.0625);
    CHECK(motion.state().acceleration == doctest::Approx(-side / 2));
    motion.step(0.0625);
    CHECK(motion.state().position == doctest::Approx(side));
    CHECK(motion.is_at_rest());
  }
}

TEST_CASE("Over random targets and holds every limit is kept at every step") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-0.33, 0.33);
  std::uniform_int_distribution<int> few(0, 99);
  std::normal_distribution<double> noise(0, 0.002);
  const double none = std::numeric_limits<double>::quiet_NaN();
  int targets = 0;
  for (const double dt_s : {0.002, 0.001, 0.0005}) {
    for (const MotionLimits& limits : {kArm, MotionLimits{-0.3, 0.3, 1.5, 60, 1000}}) {
      JerkLimitedMotion motion(limits, 0);
      Differences differences(0, dt_s);
      double moved = 0;
      double target = 0;
      for (int i = 0; i < kTargets / 6 + 1; ++i, ++targets) {
        const int dice = few(random);
        // Sometimes a new one at every step, sometimes time to arrive, sometimes noise on one.
        if (dice < 3) motion.hold();
        if (dice == 3) motion.set_target(none);
        if (dice < 40) target = place(random);
        motion.set_target(target + noise(random));
        const int steps = dice < 90 ? 1 : dice;
        for (int k = 0; k < steps; ++k) {
          const double before = motion.state().position;
          motion.step(dt_s);
          differences.see(motion.state().position);
          moved += std::abs(motion.state().position - before);
        }
      }
      CAPTURE(dt_s);
      check_within(differences.most(), limits, dt_s);
      // The limits were reached, so the test covers them.
      CHECK(differences.most().velocity > 0.9 * limits.velocity);
      CHECK(differences.most().acceleration > 0.99 * std::min(limits.acceleration, 35.0));
      CHECK(differences.most().jerk > 0.99 * limits.jerk);
      CHECK(differences.most().highest > (kTargets > 100'000 ? 0.299 : 0.25));
      CHECK(moved > 1);
    }
  }
  MESSAGE(targets, " random targets");
}

TEST_CASE("From every state it can come to rest before an end") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-0.3, 0.3);
  std::uniform_int_distribution<int> few(0, 40);
  JerkLimitedMotion motion(kArm, 0);
  for (int i = 0; i < kTargets / 20; ++i) {
    motion.set_target(i % 2 == 0 ? (i % 4 == 0 ? 0.3 : -0.3) : place(random));
    for (int k = few(random); k > 0; --k) motion.step(0.001);
    JerkLimitedMotion braking = motion;
    Differences differences(braking.state().position, 0.001);
    braking.hold();
    const double brake_s = braking.time_left_s();
    REQUIRE(brake_s <= 1.5 / 20 + 3 * 20.0 / 2000 + 1e-9);
    while (!braking.is_at_rest()) {
      braking.step(0.001);
      REQUIRE(std::abs(braking.state().position) <= 0.3 + 1e-15);
    }
  }
}

TEST_CASE("The same calls give the same bits") {
  const auto run = [] {
    JerkLimitedMotion motion(kArm, 0);
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> place(-0.3, 0.3);
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
      motion.set_target(place(random));
      motion.step(0.0013);
      sum += motion.state().position;
    }
    return sum;
  };
  CHECK(run() == run());
}

}  // namespace
}  // namespace puck
