#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "common/control/arm_controller.h"
#include "tests/control/arm_bench.h"
#include "tests/support/sanitizers.h"
#include "tests/support/test_camera.h"
#include "tests/support/wild_values.h"

namespace puck {
namespace {

constexpr int kSteps = kIsSanitized ? 10'000 : 1'000'000;

// Makes good and bad messages of every kind, in bursts of good and bad times, so that the arm moves
// and is disturbed.
class Mischief : public WildValues {
 public:
  using WildValues::WildValues;

  double target() { return between(-0.3, 0.3); }

  void spoil(ArmCommand& command) {
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
        command.target_m = wild_number(1);
        break;
      case 4:
        command.target_normalised = wild_number(1);
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
        command.mode = static_cast<CommandMode>(bits());
        break;
      case 9:
        command.estimate.session = wild_integer();
        break;
      case 10:
        command.arrive_in_us = wild_integer();
        break;
      default:
        command.from_operator = true;
        command.mode = static_cast<CommandMode>(below(4));
        break;
    }
  }
  void spoil(PublishedEstimate& estimate) {
    switch (below(7)) {
      case 0:
        estimate.utime = wild_integer();
        break;
      case 1:
        estimate.state = static_cast<TrackState>(below(4));
        break;
      case 2:
        estimate.resting = chance(0.5);
        estimate.is_live = chance(0.5);
        if (chance(0.5)) estimate.position.reset();
        break;
      case 3:
        estimate.position->x = wild_number(1);
        break;
      case 4:
        estimate.session = wild_integer();
        break;
      case 5:
        estimate.seq = chance(0.2) ? wild_integer() : estimate.seq - below(50);
        break;
      default:
        // Rarely, since the arm then rests for seconds.
        if (chance(0.001)) {
          estimate.newest_event.us = wild_integer();
        } else {
          estimate.position->y = wild_number(1);
        }
        break;
    }
  }
};

// Decides by rules of its own, looser than the arm's, whether any data justify a motion.
struct Witness {
  std::int64_t command_us = std::numeric_limits<std::int64_t>::min() / 2;
  std::int64_t estimate_us = std::numeric_limits<std::int64_t>::min() / 2;
  bool stopped = false;

  void see(const ArmCommand& c, const HostNow& now) {
    if (c.mode == CommandMode::kStop) stopped = true;
    if (c.arm_session != ArmBench::kArmSession) return;
    if (c.utime < now.utime - 200'000 || c.utime > now.utime + 200'000) return;
    if (c.mode == CommandMode::kReset && c.from_operator) stopped = false;
    if (c.mode != CommandMode::kFollow || !(std::abs(c.target_m) <= 0.32)) return;
    if (c.valid_for_us > 0) command_us = now.monotonic_us;
  }
  void see(const PublishedEstimate& e, const HostNow& now) {
    const bool in_time = e.utime >= now.utime - 200'000 && e.utime <= now.utime + 200'000;
    const bool good =
        e.state == TrackState::kTracking && e.position && std::isfinite(e.position->x);
    if (in_time && good) estimate_us = now.monotonic_us;
  }
  bool may_move(const HostNow& now) const {
    return !stopped && now.monotonic_us - command_us <= 100'000 &&
           now.monotonic_us - estimate_us <= 100'000;
  }
};

// Checks the set-points by differences of its own: finite, inside, and within the limits at any
// step.
class JudgedBackEnd : public ArmBackEnd {
 public:
  struct Verdict {
    std::int64_t sent = 0;
    std::int64_t bad = 0;
    double most_speed = 0;  // as shares of the limits
    double most_acceleration = 0;
    double most_jerk = 0;
  };

  JudgedBackEnd(const JointTable& table, Verdict& verdict)
      : verdict_(verdict), table_(table), joints_({}, table, middle()) {}

  std::string_view name() const override { return "judged"; }
  void command(const JointAngles& set_point, std::int64_t monotonic_us) override {
    ++verdict_.sent;
    for (std::size_t k = 0; k < set_point.size(); ++k) judge(k, set_point[k]);
    joints_.command(set_point, monotonic_us);
  }
  std::optional<JointReading> reading(std::int64_t monotonic_us) override {
    return joints_.reading(monotonic_us);
  }
  std::string fault(std::int64_t monotonic_us) override { return joints_.fault(monotonic_us); }

 private:
  struct Last {
    double deg = 0;
    double velocity = 0;
    double acceleration = 0;
  };
  static constexpr double kDtS = 0.001;

  JointAngles middle() {
    std::array<double, 7> deg{};
    table_.at(0, deg);
    for (std::size_t k = 0; k < deg.size(); ++k) last_[k].deg = deg[k];
    return JointAngles(deg);
  }

  void judge(std::size_t joint, double deg) {
    Last& last = last_[joint];
    const MotionLimits& limits = table_.limits(joint);
    const double velocity = (deg - last.deg) / kDtS;
    const double acceleration = (velocity - last.velocity) / kDtS;
    const double speed = std::abs(velocity) / limits.velocity;
    const double change = std::abs(acceleration) / limits.acceleration;
    const double jerk = std::abs(acceleration - last.acceleration) / kDtS / limits.jerk;
    // 1e-12 deg of rounding make 1e-3 deg/s³ of 400 000.
    constexpr double kRounding = 1 + 1e-6;
    const bool is_good = std::isfinite(deg) && deg >= limits.lowest && deg <= limits.highest &&
                         speed <= kRounding && change <= kRounding && jerk <= kRounding;
    if (!is_good) ++verdict_.bad;
    verdict_.most_speed = std::max(verdict_.most_speed, speed);
    verdict_.most_acceleration = std::max(verdict_.most_acceleration, change);
    verdict_.most_jerk = std::max(verdict_.most_jerk, jerk);
    last = {deg, velocity, acceleration};
  }

  Verdict& verdict_;
  const JointTable& table_;
  std::array<Last, JointAngles::kMost> last_{};
  SimulatedBackEnd joints_;
};

struct Play {
  std::int64_t steps = 0;
  std::int64_t messages = 0;
  std::int64_t moved = 0;
  std::int64_t braked_without_leave = 0;
};

// The messages during `steps` steps of the arm, a millisecond each.
void play(ArmBench& bench, Mischief& mischief, bool follows, int steps, Play& play) {
  const JerkLimitedMotion& line = bench.arm.motion().line();
  const MotionLimits limits = line.limits();
  Witness witness;
  double target_m = 0;
  double without_leave_s = 0;
  // Shares of commands and estimates that are sent, and of those that are modified.
  double command_rate = 1;
  double estimate_rate = 1;
  double spoilt = 0;
  for (int i = 0; i < steps; ++i, ++play.steps) {
    if (i % 250 == 0) {
      command_rate = mischief.chance(0.3) ? 0 : 0.5;
      estimate_rate = mischief.chance(0.3) ? 0 : 0.5;
      spoilt = mischief.chance(0.4) ? 0.5 : 0.01;
      if (mischief.chance(0.8)) {
        ArmCommand reset = bench.command(0);
        reset.session = 50'000 + i;
        reset.mode = CommandMode::kReset;
        reset.from_operator = 1;
        witness.see(reset, bench.now);
        bench.arm.hear(reset, bench.now, bench.sender);
      }
    }
    if (mischief.chance(0.02)) target_m = mischief.target();
    if (mischief.chance(estimate_rate)) {
      PublishedEstimate estimate = bench.estimate();
      if (follows) {
        estimate.position = *test_camera().to_image({1, target_m});
      }
      if (mischief.chance(spoilt)) mischief.spoil(estimate);
      witness.see(estimate, bench.now);
      bench.arm.hear(estimate, bench.now, bench.sender);
      ++play.messages;
    }
    if (mischief.chance(command_rate)) {
      ArmCommand command = bench.command(target_m);
      if (mischief.chance(spoilt)) mischief.spoil(command);
      witness.see(command, bench.now);
      bench.arm.hear(command, bench.now, bench.sender);
      ++play.messages;
    }

    const MotionState before = line.state();
    bench.run(1);
    const MotionState after = line.state();
    constexpr double kRounding = 1e-9;
    REQUIRE(std::isfinite(after.position));
    REQUIRE(std::abs(after.position) <= limits.highest);
    REQUIRE(std::abs(after.velocity) <= limits.velocity + kRounding);
    REQUIRE(std::abs(after.acceleration) <= limits.acceleration + kRounding);
    REQUIRE(std::abs(after.position - before.position) <= limits.velocity * 0.001 + kRounding);
    REQUIRE(std::abs(bench.arm.position_m() - after.position) < 0.05);
    if (std::abs(after.velocity) > 0.1) ++play.moved;
    // In mode follow no command is needed.
    if (follows) witness.command_us = bench.now.monotonic_us;
    without_leave_s = witness.may_move(bench.now) ? 0 : without_leave_s + 0.001;
    // The acceleration is reduced first. To rest from any state within V/A + 3 A/J.
    const double ease_s = limits.acceleration / limits.jerk + 0.001;
    if (without_leave_s > ease_s) {
      REQUIRE(std::abs(after.velocity) <= std::abs(before.velocity) + kRounding);
    }
    if (without_leave_s > limits.velocity / limits.acceleration + 3 * ease_s) {
      REQUIRE(after.velocity == 0);
    }
    if (without_leave_s > 0 && std::abs(before.velocity) > 0.1) ++play.braked_without_leave;
  }
}

TEST_CASE("Whatever arrives, the arm keeps its limits and only brakes without command and track") {
  for (const bool follows : {false, true}) {
    ArmControllerParams params;
    if (follows) {
      params.mode = ArmMode::kFollow;
      params.view = ArmView{test_camera(), {}};
    }
    const JointTable table(params.arm.joints);
    Play sum;
    JudgedBackEnd::Verdict verdict;
    std::int64_t readings_to_begin = 0;
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
      ArmBench bench(params, 0, std::make_unique<JudgedBackEnd>(table, verdict));
      Mischief mischief(seed);
      play(bench, mischief, follows, (follows ? kSteps / 10 : kSteps) / 5, sum);
      REQUIRE(bench.arm.guard().faults() == 0);
      readings_to_begin += SteadyStart::kReadings - 1;
    }
    MESSAGE(std::string(follows ? "mode follow: " : "mode commanded: "), sum.steps, " steps, ",
            sum.messages, " messages; of the joints' limits at most ", 100 * verdict.most_speed,
            " % of the speed, ", 100 * verdict.most_acceleration, " % of the acceleration, ",
            100 * verdict.most_jerk, " % of the jerk");
    CHECK(verdict.sent == sum.steps - readings_to_begin);
    CHECK(verdict.bad == 0);
    // The test must have covered its subject.
    CHECK(sum.moved > sum.steps / 100);
    CHECK(sum.braked_without_leave >= sum.steps / 5000);
    CHECK(verdict.most_jerk > 0.3);
  }
}

}  // namespace
}  // namespace puck
