#include "common/control/arm_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/control/arm_bench.h"

namespace puck {
namespace {

// Scripted joints, which follow at once by default.
class ScriptedBackEnd : public ArmBackEnd {
 public:
  struct Script {
    std::optional<JointAngles> at;  // the encoders
    bool follows = true;
    bool speaks = true;
    std::optional<std::int64_t> stamp_us;  // of readings, if constant
    std::string fault;
    std::string awaited;
    bool holds = true;
    int withdrawals = 0;
    std::vector<JointAngles> sent;
  };
  explicit ScriptedBackEnd(Script& script) : script_(script) {}

  std::string_view name() const override { return "scripted"; }
  void command(const JointAngles& set_point, std::int64_t) override {
    script_.sent.push_back(set_point);
    if (script_.follows && script_.holds) script_.at = set_point;
  }
  std::optional<JointReading> reading(std::int64_t monotonic_us) override {
    if (!script_.speaks || !script_.at) return std::nullopt;
    return JointReading{*script_.at, script_.stamp_us.value_or(monotonic_us)};
  }
  std::string fault(std::int64_t) override { return script_.fault; }
  std::string awaited() override { return script_.awaited; }
  void withdraw() override { ++script_.withdrawals; }
  bool holds() override { return script_.holds; }

 private:
  Script& script_;
};

JointAngles joints_at(double y_m) {
  std::array<double, 7> deg{};
  JointTable(simulated_joints()).at(y_m, deg);
  return JointAngles(deg);
}

class ScriptedArm {
 public:
  explicit ScriptedArm(double y_m) : bench({}, 0, std::make_unique<ScriptedBackEnd>(script)) {
    script.at = joints_at(y_m);
  }
  explicit ScriptedArm(const ArmControllerParams& params)
      : bench(params, 0, std::make_unique<ScriptedBackEnd>(script)) {}

  std::string reason() const { return bench.arm.state().reason; }
  bool is_faulty() const { return bench.arm.state().activity == ArmActivity::kFault; }

  ScriptedBackEnd::Script script;
  ArmBench bench;
};

TEST_CASE("The set-points begin at the encoders, at any place on the line") {
  for (const double y_m : {-0.3, -0.17, 0.0, 0.3}) {
    ScriptedArm arm(y_m);
    arm.bench.run(SteadyStart::kReadings);
    REQUIRE(arm.script.sent.size() == 1);
    for (std::size_t k = 0; k < 7; ++k) {
      CHECK(arm.script.sent[0][k] == doctest::Approx(joints_at(y_m)[k]).epsilon(1e-9));
    }
    CHECK(arm.bench.arm.position_m() == doctest::Approx(y_m));
    arm.bench.run(50);
    CHECK(arm.bench.arm.position_m() == doctest::Approx(y_m));
    CHECK(arm.bench.arm.state().activity == ArmActivity::kIdle);
  }
}

TEST_CASE("Without encoders nothing is sent, and the arm names the missing data") {
  ScriptedArm arm(0);
  arm.script.speaks = false;
  arm.bench.play(200, 0.1);
  CHECK(arm.script.sent.empty());
  CHECK(arm.reason() == "waiting for the encoders");
  arm.script.awaited = "the robot is off";
  arm.bench.play(1, 0.1);
  CHECK(arm.reason() == "waiting for the encoders: the robot is off");
  CHECK(arm.bench.arm.state().activity == ArmActivity::kIdle);
  CHECK(!arm.is_faulty());
  arm.script.speaks = true;
  arm.bench.play(400, 0.1);
  CHECK(arm.bench.arm.position_m() == doctest::Approx(0.1));
}

TEST_CASE("A stopped arm takes no joints before a reset, whatever its back end reports") {
  for (const bool was_asking : {false, true}) {
    CAPTURE(was_asking);
    ScriptedArm arm(0);
    arm.script.holds = false;
    arm.script.speaks = was_asking;
    arm.bench.play(200, 0.1);
    CHECK(arm.script.sent.empty() == !was_asking);
    arm.bench.operate(CommandMode::kStop);
    arm.script.speaks = true;
    arm.script.sent.clear();
    arm.script.withdrawals = 0;
    arm.bench.play(200, 0.1);
    CHECK(arm.script.sent.empty());
    CHECK(arm.script.withdrawals > 0);
    CHECK(arm.bench.arm.state().activity == ArmActivity::kStopped);
    // Joints that the arm has not taken may be moved by others without a fault.
    arm.script.at = joints_at(0.2);
    arm.bench.play(200, 0.1);
    CHECK(!arm.is_faulty());
    arm.bench.operate(CommandMode::kReset);
    arm.bench.play(1, 0.1);
    arm.script.holds = true;
    arm.bench.play(600, 0.1);
    CHECK(!arm.is_faulty());
    CHECK(arm.bench.arm.position_m() == doctest::Approx(0.1));
  }
}

TEST_CASE("After a stop an arm that holds its joints continues with set-points at rest") {
  ScriptedArm arm(0);
  arm.bench.play(300, 0.1);
  arm.bench.operate(CommandMode::kStop);
  arm.bench.play(200, 0.1);
  arm.script.sent.clear();
  arm.script.withdrawals = 0;
  arm.bench.play(10, 0.1);
  CHECK(arm.script.sent.size() == 10);
  CHECK(arm.script.withdrawals == 0);
}

TEST_CASE("Set-points wait for joints that are still being taken") {
  ScriptedArm arm(0);
  arm.script.holds = false;
  arm.bench.play(1000, 0.2);
  REQUIRE(!arm.script.sent.empty());
  CHECK(arm.script.sent.back()[0] == doctest::Approx(joints_at(0)[0]));
  arm.script.holds = true;
  arm.bench.play(1000, 0.2);
  CHECK(!arm.is_faulty());
  CHECK(arm.bench.arm.position_m() == doctest::Approx(0.2));
}

TEST_CASE("An arm whose joints become unready waits, and restarts at their position") {
  ScriptedArm arm(0);
  arm.script.holds = false;
  arm.bench.play(200, 0.1);
  REQUIRE(!arm.script.sent.empty());
  arm.script.speaks = false;
  arm.script.awaited = "it is being calibrated";
  arm.script.sent.clear();
  arm.bench.play(500, 0.1);
  CHECK(arm.script.sent.empty());
  CHECK(arm.reason() == "waiting for the encoders: it is being calibrated");
  CHECK(arm.bench.arm.state().activity == ArmActivity::kIdle);
  arm.script.at = joints_at(-0.2);
  arm.script.speaks = arm.script.holds = true;
  arm.bench.play(800, 0.1);
  CHECK(!arm.is_faulty());
  CHECK(arm.bench.arm.position_m() == doctest::Approx(0.1));
}

TEST_CASE("A back end's fault withdraws its unsent set-points") {
  ScriptedArm arm(0);
  arm.bench.play(200, 0.1);
  CHECK(arm.script.withdrawals == SteadyStart::kReadings - 1);
  arm.script.fault = "no connection";
  arm.bench.play(1, 0.1);
  CHECK(arm.script.withdrawals == SteadyStart::kReadings);
}

TEST_CASE("One wrong reading among the first causes no motion") {
  for (const int wrong_one : {0, 1, SteadyStart::kReadings - 1}) {
    for (const double off_deg : {-6.0, 6.0, 300.0}) {
      CAPTURE(wrong_one);
      CAPTURE(off_deg);
      ScriptedArm arm(0.1);
      for (int i = 0; i < 2 * SteadyStart::kReadings; ++i) {
        arm.script.at = joints_at(0.1);
        if (i == wrong_one) (*arm.script.at)[0] += off_deg;
        arm.bench.play(1, 0.1);
      }
      REQUIRE(!arm.is_faulty());
      REQUIRE(!arm.script.sent.empty());
      for (std::size_t k = 0; k < 7; ++k) {
        CHECK(arm.script.sent[0][k] == doctest::Approx(joints_at(0.1)[k]).epsilon(1e-9));
      }
      CHECK(arm.bench.arm.position_m() == doctest::Approx(0.1));
    }
  }
}

TEST_CASE("Repeated readings count once, and encoders that never agree are not accepted") {
  ScriptedArm arm(0.1);
  arm.script.stamp_us = arm.bench.now.monotonic_us;
  arm.bench.play(50, 0.1);
  CHECK(arm.script.sent.empty());
  CHECK(arm.reason() == "waiting for stable encoder readings");
  arm.script.stamp_us.reset();
  for (int i = 0; i < 50; ++i) {
    arm.script.at = joints_at(i % 2 == 0 ? 0.1 : 0.12);
    arm.bench.play(1, 0.1);
  }
  CHECK(arm.script.sent.empty());
  CHECK(!arm.is_faulty());
}

TEST_CASE("An arm off the line moves to it slowly, only on request, and then plays") {
  ScriptedArm arm(0.1);
  (*arm.script.at)[1] += 4;
  const double from = (*arm.script.at)[1];
  arm.bench.run(100);
  CHECK((*arm.script.at)[1] == from);
  arm.bench.play(300, 0.25);
  CHECK(arm.reason() == "moving to the line");
  CHECK(arm.bench.arm.state().activity == ArmActivity::kMoving);
  const double on_the_way = (*arm.script.at)[1];
  CHECK(on_the_way < from);
  // At most 10 deg/s.
  CHECK(on_the_way > from - 3);
  arm.bench.run(400);
  const double stopped = (*arm.script.at)[1];
  arm.bench.run(400);
  CHECK((*arm.script.at)[1] == stopped);
  arm.bench.play(1500, 0.25);
  CHECK(arm.bench.arm.position_m() == doctest::Approx(0.25));
  CHECK(arm.reason().empty());
  double before = from;
  for (const JointAngles& sent : arm.script.sent) {
    REQUIRE(std::abs(sent[1] - before) <= 0.2);
    before = sent[1];
  }
}

TEST_CASE("A joint outside its limits is a fault, and nothing is sent") {
  ScriptedArm arm(0);
  (*arm.script.at)[2] = 99;
  arm.bench.play(50, 0.1);
  CHECK(arm.is_faulty());
  CHECK(arm.reason().find("joint 2 stands at 99.000000 deg, outside its limits") == 0);
  CHECK(arm.script.sent.empty());
}

TEST_CASE("A joint that does not follow is a fault: the set-points stop until a reset") {
  ScriptedArm arm(-0.3);
  arm.bench.play(10, 0.3);
  arm.script.follows = false;
  arm.bench.play(300, 0.3);
  CHECK(arm.is_faulty());
  CHECK(arm.reason().find("does not follow") != std::string::npos);
  CHECK(arm.bench.stands());
  CHECK(arm.bench.arm.state().faults == 1);
  CHECK(arm.bench.arm.motion().line().state().position < 0.1);
  // It restarts at the encoders, not at the last set-points.
  arm.script.follows = true;
  const JointAngles at = *arm.script.at;
  arm.script.sent.clear();
  arm.bench.operate(CommandMode::kReset);
  arm.bench.run(SteadyStart::kReadings);
  REQUIRE(!arm.script.sent.empty());
  for (std::size_t k = 0; k < 7; ++k) CHECK(std::abs(arm.script.sent[0][k] - at[k]) < 0.01);
  CHECK(!arm.is_faulty());
  arm.bench.play(800, 0.3);
  CHECK(arm.bench.arm.position_m() == doctest::Approx(0.3));
}

TEST_CASE("After a reset during braking the set-points first come to rest") {
  ScriptedArm arm(-0.3);
  arm.bench.play(200, 0.3);
  REQUIRE(arm.bench.arm.motion().line().state().velocity > 1);
  // For a moment an encoder is wrong.
  (*arm.script.at)[2] += 11;
  arm.bench.play(1, 0.3);
  REQUIRE(arm.is_faulty());
  arm.bench.operate(CommandMode::kReset);
  arm.bench.play(10, 0.3);
  CHECK(!arm.is_faulty());
  CHECK(!arm.bench.stands());
  arm.bench.play(600, 0.3);
  CHECK(arm.bench.arm.position_m() == doctest::Approx(0.3));
  // 1.5 m/s are 73 deg/s of joint 0: nowhere does it change by more than its 3500 deg/s^2 allow.
  for (std::size_t i = 2; i < arm.script.sent.size(); ++i) {
    const double change =
        arm.script.sent[i][0] - 2 * arm.script.sent[i - 1][0] + arm.script.sent[i - 2][0];
    REQUIRE(std::abs(change) <= 3500 * 0.001 * 0.001 * (1 + 1e-6));
  }
}

TEST_CASE("Silent encoders, or a constant stamp, are a fault after 100 ms") {
  for (const bool stamp_stands : {false, true}) {
    CAPTURE(stamp_stands);
    ScriptedArm arm(0);
    arm.bench.play(50, 0.02);
    if (stamp_stands) {
      arm.script.stamp_us = arm.bench.now.monotonic_us;
    } else {
      arm.script.speaks = false;
    }
    arm.bench.play(100, 0.02);
    CHECK(!arm.is_faulty());
    arm.bench.play(1, 0.02);
    CHECK(arm.is_faulty());
    CHECK(arm.reason() == "encoders silent");
    arm.bench.operate(CommandMode::kReset);
    arm.bench.run(1);
    CHECK(arm.reason() == "waiting for the encoders");
  }
}

TEST_CASE("Encoders that are not finite, or of other joints, are a fault and cause no motion") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [bad, why] :
       {std::pair{JointAngles(std::array<double, 7>{0, 0, nan, 0, 0, 0, 0}), "not finite"},
        std::pair{JointAngles(std::array<double, 7>{1e308, -1e308, 0, 0, 0, 0, 0}),
                  "out of the possible range"},
        std::pair{JointAngles(std::array<double, 3>{0, 0, 0}), "not that of the joint table"}}) {
    ScriptedArm arm(0);
    arm.bench.play(200, 0.05);
    arm.script.follows = false;
    arm.script.at = bad;
    arm.bench.play(200, 0.25);
    CHECK(arm.is_faulty());
    CHECK(arm.reason().find(why) != std::string::npos);
    CHECK(arm.bench.arm.position_m() == doctest::Approx(0.05));
    CHECK(arm.bench.stands());
  }
}

TEST_CASE("A back end's fault stops the arm until a reset, and again if the fault persists") {
  ScriptedArm arm(0);
  arm.bench.play(20, 0.3);
  arm.script.fault = "no connection";
  arm.bench.play(1, 0.3);
  CHECK(arm.is_faulty());
  CHECK(arm.reason() == "no connection");
  arm.script.fault.clear();
  arm.script.sent.clear();
  arm.bench.play(100, 0.3);
  CHECK(arm.script.sent.empty());
  arm.script.fault = "no connection";
  arm.bench.operate(CommandMode::kReset);
  arm.bench.run(1);
  CHECK(arm.is_faulty());
  CHECK(arm.bench.arm.state().faults == 2);
  arm.script.fault.clear();
  arm.bench.operate(CommandMode::kReset);
  arm.bench.play(500, 0.3);
  CHECK(arm.bench.arm.position_m() == doctest::Approx(0.3));
  CHECK(arm.bench.arm.state().back_end == "scripted");
}

TEST_CASE("After a pause of its loop the motion continues from rest, without a jump") {
  ScriptedArm arm(-0.3);
  arm.bench.play(100, 0.3);
  CHECK(arm.bench.arm.motion().line().state().velocity > 1);
  const JointAngles before = arm.script.sent.back();
  arm.bench.arm.rest();
  arm.bench.now.utime += 50'000;
  arm.bench.now.monotonic_us += 50'000;
  arm.bench.play(1, 0.3);
  for (std::size_t k = 0; k < 7; ++k) {
    CHECK(std::abs(arm.script.sent.back()[k] - before[k]) < 1e-3);
  }
  arm.bench.play(600, 0.3);
  CHECK(!arm.is_faulty());
  CHECK(arm.bench.arm.position_m() == doctest::Approx(0.3));
}

TEST_CASE("The arm reports its joints and their velocities from the encoders") {
  ScriptedArm arm(-0.2);
  arm.bench.play(120, 0.2);
  const ArmState state = arm.bench.arm.state();
  REQUIRE(state.joint_deg.size() == 7);
  REQUIRE(state.joint_deg.size() == 7);
  REQUIRE(state.joint_velocity_deg_s.size() == 7);
  // Read before the newest set-point was sent.
  CHECK(state.joint_deg[3] == arm.script.sent[arm.script.sent.size() - 2][3]);
  // Of 1.5 m/s, joint 0 at about 53 deg/m and more.
  CHECK(state.velocity_m_s == doctest::Approx(1.5));
  CHECK(state.joint_velocity_deg_s[0] > 50);
}

TEST_CASE("A line outside the joint table is refused, as are invalid limits") {
  ArmControllerParams params;
  params.guard.line_half_m = 0.31;
  CHECK_THROWS_WITH_AS(ArmController(params, 1),
                       "arm.line_half_m exceeds the range of arm.joint_table, -0.300000 to "
                       "0.300000 m",
                       std::invalid_argument);
  params = {};
  params.arm.max_jerk_m_s3 = 0;
  CHECK_THROWS_WITH_AS(ArmController(params, 1), "arm.max_jerk_m_s3 must be above 0",
                       std::invalid_argument);
  params = {};
  params.arm.approach_deg_s = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(ArmController(params, 1), std::invalid_argument);
}

TEST_CASE("Joints slower than the line's limits reduce the limits") {
  ArmControllerParams params;
  for (LineJoint& joint : params.arm.joints.joints) joint.limits.velocity = 30;
  ArmBench bench(params);
  CHECK(bench.arm.motion().line().limits().velocity < 0.4);
  bench.play(200, 0.3);
  CHECK(bench.arm.velocity_m_s() < 0.4);
  bench.play(1500, 0.3);
  CHECK(bench.arm.position_m() == doctest::Approx(0.3));
  CHECK(bench.arm.state().faults == 0);
}

}  // namespace
}  // namespace puck
