#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <doctest/doctest.h>

#include "common/control/arm_controller.h"
#include "tests/control/arm_bench.h"

namespace puck {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kSteps = 10'000;
#else
constexpr int kSteps = 100'000;
#endif

// Makes what the arm may meet on the bus: good messages and every kind of bad one, in bursts of
// good and bad times so that the arm moves as well as it is disturbed.
class Mischief {
 public:
  explicit Mischief(unsigned seed) : random_(seed) {}

  bool chance(double probability) { return std::bernoulli_distribution(probability)(random_); }
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }

  double wild_number() {
    switch (below(7)) {
      case 0:
        return std::numeric_limits<double>::quiet_NaN();
      case 1:
        return std::numeric_limits<double>::infinity();
      case 2:
        return -std::numeric_limits<double>::infinity();
      case 3:
        return 1e308;
      case 4:
        return std::numeric_limits<double>::denorm_min();
      default:
        return std::normal_distribution<double>(0, 0.5)(random_);
    }
  }
  std::int64_t wild_integer() {
    switch (below(5)) {
      case 0:
        return std::numeric_limits<std::int64_t>::max();
      case 1:
        return std::numeric_limits<std::int64_t>::min();
      case 2:
        return 0;
      default:
        return static_cast<std::int64_t>(random_());
    }
  }
  double target() { return std::uniform_real_distribution<double>(-0.3, 0.3)(random_); }

  void spoil(arm_command_t& command) {
    switch (below(12)) {
      case 0:
        command.utime += (chance(0.5) ? 1 : -1) * (200'001 + below(1'000'000));
        break;
      case 1:
        command.utime = wild_integer();
        break;
      case 2:
        command.arm_session = wild_integer();
        break;
      case 3:
        command.target_m = wild_number();
        break;
      case 4:
        command.target_normalised = wild_number();
        break;
      case 5:
        command.valid_for_us = wild_integer();
        break;
      case 6:
        command.session = wild_integer();
        break;
      case 7:
        command.seq -= below(50);
        break;
      case 8:
        command.mode = static_cast<std::int8_t>(random_());
        break;
      case 9:
        command.estimate_session = wild_integer();
        break;
      case 10:
        command.arrive_in_us = wild_integer();
        break;
      default:
        command.from_operator = 1;
        command.mode = static_cast<std::int8_t>(below(4));
        break;
    }
  }
  void spoil(puck_estimate_t& estimate) {
    switch (below(7)) {
      case 0:
        estimate.utime = wild_integer();
        break;
      case 1:
        estimate.state = static_cast<std::int8_t>(below(4));
        break;
      case 2:
        estimate.flags = static_cast<std::int32_t>(random_());
        break;
      case 3:
        estimate.x_px = wild_number();
        break;
      case 4:
        estimate.session = wild_integer();
        break;
      case 5:
        estimate.seq = chance(0.2) ? wild_integer() : estimate.seq - below(50);
        break;
      default:
        estimate.sensor_us = wild_integer();
        break;
    }
  }

 private:
  std::mt19937_64 random_;
};

// Judges by rules of its own, looser than the arm's, whether anything at all speaks for moving.
struct Witness {
  std::int64_t command_us = std::numeric_limits<std::int64_t>::min() / 2;
  std::int64_t estimate_us = std::numeric_limits<std::int64_t>::min() / 2;
  bool stopped = false;

  void see(const arm_command_t& c, const HostNow& now) {
    if (c.mode == arm_command_t::MODE_STOP) stopped = true;
    if (c.arm_session != ArmBench::kArmSession) return;
    if (c.utime < now.utime - 200'000 || c.utime > now.utime + 200'000) return;
    if (c.mode == arm_command_t::MODE_RESET && c.from_operator) stopped = false;
    if (c.mode != arm_command_t::MODE_FOLLOW || !(std::abs(c.target_m) <= 0.32)) return;
    if (c.valid_for_us > 0) command_us = now.monotonic_us;
  }
  void see(const puck_estimate_t& e, const HostNow& now) {
    const bool in_time = e.utime >= now.utime - 200'000 && e.utime <= now.utime + 200'000;
    const bool good = e.state == puck_estimate_t::STATE_TRACKING &&
                      (e.flags & puck_estimate_t::FLAG_POSITION) != 0 && std::isfinite(e.x_px);
    if (in_time && good) estimate_us = now.monotonic_us;
  }
  bool may_move(const HostNow& now) const {
    return !stopped && now.monotonic_us - command_us <= 100'000 &&
           now.monotonic_us - estimate_us <= 100'000;
  }
};

TEST_CASE("Whatever arrives, the arm keeps its limits and only brakes without command and track") {
  const ArmControllerParams params;
  int moved = 0;
  int braked_without_leave = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    ArmBench bench(params);
    const JerkLimitedMotion& line = bench.arm.motion().line();
    Mischief mischief(seed);
    Witness witness;
    double target_m = 0;
    double without_leave_s = 0;
    // Shares of commands and estimates that are sent, and of those that are spoilt.
    double command_rate = 1;
    double estimate_rate = 1;
    double spoilt = 0;
    for (int i = 0; i < kSteps / 5; ++i) {
      if (i % 250 == 0) {
        command_rate = mischief.chance(0.3) ? 0 : 0.5;
        estimate_rate = mischief.chance(0.3) ? 0 : 0.5;
        spoilt = mischief.chance(0.4) ? 0.5 : 0.01;
        if (mischief.chance(0.8)) {
          arm_command_t reset = bench.command(0);
          reset.session = 50'000 + i;
          reset.mode = arm_command_t::MODE_RESET;
          reset.from_operator = 1;
          witness.see(reset, bench.now);
          bench.arm.hear(reset, bench.now, bench.sender);
        }
      }
      if (mischief.chance(0.02)) target_m = mischief.target();
      if (mischief.chance(estimate_rate)) {
        puck_estimate_t estimate = bench.estimate();
        if (mischief.chance(spoilt)) mischief.spoil(estimate);
        witness.see(estimate, bench.now);
        bench.arm.hear(estimate, bench.now, bench.sender);
      }
      if (mischief.chance(command_rate)) {
        arm_command_t command = bench.command(target_m);
        if (mischief.chance(spoilt)) mischief.spoil(command);
        witness.see(command, bench.now);
        bench.arm.hear(command, bench.now, bench.sender);
      }

      const double position_before = line.state().position;
      const double velocity_before = line.state().velocity;
      bench.run(1);
      const double position = line.state().position;
      const double velocity = line.state().velocity;
      constexpr double kRounding = 1e-9;
      REQUIRE(std::isfinite(position));
      REQUIRE(std::abs(position) <= params.guard.line_half_m + kRounding);
      REQUIRE(std::abs(velocity) <= params.arm.max_speed_m_s + kRounding);
      REQUIRE(std::abs(velocity - velocity_before) <=
              params.arm.max_acceleration_m_s2 * 0.001 + kRounding);
      REQUIRE(std::abs(position - position_before) <= params.arm.max_speed_m_s * 0.001 + kRounding);
      if (std::abs(velocity) > 0.1) ++moved;
      if (!witness.may_move(bench.now)) {
        // The acceleration is let go first.
        const double wait_s = params.arm.max_acceleration_m_s2 / params.arm.max_jerk_m_s3 + 0.001;
        without_leave_s += 0.001;
        if (without_leave_s > wait_s) {
          REQUIRE(std::abs(velocity) <= std::abs(velocity_before) + kRounding);
        }
        if (without_leave_s > 0.15) REQUIRE(velocity == 0);
        if (std::abs(velocity_before) > 0.1) ++braked_without_leave;
      } else {
        without_leave_s = 0;
      }
    }
  }
  // The test has to have met what it is about.
  CHECK(moved > kSteps / 100);
  CHECK(braked_without_leave > 20);
}

}  // namespace
}  // namespace puck
