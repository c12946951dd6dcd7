#include "common/yarp/set_point_gate.h"

#include <array>
#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>

namespace puck {
namespace {

YarpParams two_joints() {
  YarpParams params;
  params.joints = {1, 4};
  params.lowest_deg = {-10, 0};
  params.highest_deg = {10, 90};
  return params;
}

JointAngles deg(double first, double second) { return JointAngles(std::array{first, second}); }

}  // namespace

TEST_CASE(
    "the first set-point begins at the encoders, each later one at its predecessor or there") {
  const YarpParams params = two_joints();
  SetPointGate gate(params);
  const JointAngles encoders = deg(5, 40);
  CHECK(gate.refusal(deg(5, 42.5), encoders) ==
        "the set-point of joint 4, 42.5 deg, does not begin at its encoder, 40 deg");
  CHECK(gate.refusal(deg(5, 42), encoders).empty());
  CHECK(gate.refusal(deg(10, 47), encoders).empty());
  CHECK(gate.refusal(deg(10, 52), encoders).empty());
  // An arm that did not follow restarts at its position.
  CHECK(gate.refusal(deg(3, 38), encoders).empty());
  CHECK(gate.refusal(deg(8, 43), encoders).empty());
  CHECK(
      gate.refusal(deg(8, 48.5), encoders) ==
      "the set-point of joint 4, 48.5 deg, is too far from the one before, 43 deg: were set-points "
      "held up?");
  CHECK(gate.refusal(deg(8, 43), encoders) ==
        "the set-point of joint 1, 8 deg, does not begin at its encoder, 5 deg");
}

TEST_CASE("after a restart the next set-point begins at the encoders") {
  const YarpParams params = two_joints();
  SetPointGate gate(params);
  CHECK(gate.refusal(deg(5, 40), deg(5, 40)).empty());
  CHECK(gate.refusal(deg(5, 43), deg(5, 40)).empty());
  gate.restart();
  CHECK(!gate.refusal(deg(5, 43), deg(5, 40)).empty());
}

TEST_CASE("set-points that are not finite, outside the limits or of other joints are not sent") {
  const YarpParams params = two_joints();
  const JointAngles encoders = deg(5, 40);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const JointAngles& wrong :
       {deg(nan, 40), deg(5, infinity), deg(-infinity, 40), deg(10.001, 40), deg(5, -0.001),
        JointAngles(std::array{5.0}), JointAngles(std::array{5.0, 40.0, 1.0}), JointAngles()}) {
    SetPointGate gate(params);
    CHECK(gate.refusal(encoders, encoders).empty());
    CHECK(!gate.refusal(wrong, encoders).empty());
    // Then it restarts.
    CHECK(!gate.refusal(deg(1, 40), encoders).empty());
    CHECK(gate.refusal(encoders, encoders).empty());
    CHECK(gate.refusal(deg(1, 40), encoders).empty());
  }
}

TEST_CASE("an arm without a reading takes no set-points") {
  const YarpParams params = two_joints();
  SetPointGate gate(params);
  CHECK(!gate.refusal(deg(5, 40), JointAngles()).empty());
}

TEST_CASE("impossible settings of the board are refused by name") {
  const auto refusal = [](auto change) {
    YarpParams params = two_joints();
    change(params);
    try {
      check(params);
      return std::string();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  CHECK(refusal([](YarpParams&) {}).empty());
  CHECK(refusal([](YarpParams& p) { p.port = 0; }) ==
        "arm.yarp.port must be from 1 to 65535, got 0");
  CHECK(refusal([](YarpParams& p) { p.host.clear(); }).starts_with("arm.yarp.host "));
  for (const char* robot : {"", "icub", "/", "/i cub", "/icub/", "/icub\n"}) {
    CHECK(refusal([&](YarpParams& p) { p.robot = robot; }).starts_with("arm.yarp.robot "));
  }
  for (const char* part : {"", "/arm", "arm/", "right arm"}) {
    CHECK(refusal([&](YarpParams& p) { p.part = part; }).starts_with("arm.yarp.part "));
  }
  CHECK(refusal([](YarpParams& p) { p.local_name = "/puck"; }).starts_with("arm.yarp.local_name "));
  for (const std::vector<int>& joints : {std::vector<int>{},
                                         {4, 1},
                                         {1, 1},
                                         {-1, 1},
                                         {1, 64},
                                         {1},
                                         {1, 2, 3},
                                         std::vector<int>(17)}) {
    CHECK(refusal([&](YarpParams& p) { p.joints = joints; }).starts_with("arm.yarp.joints "));
  }
  CHECK(refusal([](YarpParams& p) { p.lowest_deg[1] = 90; }).starts_with("arm.yarp.joints "));
  CHECK(refusal([](YarpParams& p) {
          p.highest_deg[0] = std::numeric_limits<double>::infinity();
        }).starts_with("arm.yarp.joints "));
  CHECK(refusal([](YarpParams& p) { p.silent_ms = 39; }).starts_with("arm.yarp.silent_ms "));
  CHECK(refusal([](YarpParams& p) { p.start_within_deg = 0; }) ==
        "arm.yarp.start_within_deg must be from 0.1 to 10, got 0");
  CHECK(refusal([](YarpParams& p) { p.max_step_deg = 11; }) ==
        "arm.yarp.max_step_deg must be from 0.1 to 10, got 11");
}

}  // namespace puck
