#include "common/yarp/yarp_params.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/control/joint_angles.h"
#include "common/yarp/port_query.h"
#include "common/yarp/state_message.h"

namespace puck {
namespace {

void require(bool holds, const std::string& key, const std::string& what) {
  if (!holds) throw std::invalid_argument("arm.yarp." + key + " " + what);
}

void require_between(double value, double lowest, double highest, const std::string& key) {
  const auto plain = [](double number) {
    std::string text = std::to_string(number);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  };
  require(value >= lowest && value <= highest, key,
          "must be from " + plain(lowest) + " to " + plain(highest) + ", got " + plain(value));
}

void check_joints(const YarpParams& params) {
  const auto& joints = params.joints;
  const auto is_in_range = [](int joint) {
    return joint >= 0 && joint < static_cast<int>(kMostBoardJoints);
  };
  require(!joints.empty() && joints.size() <= JointAngles::kMost, "joints",
          "must be 1 to " + std::to_string(JointAngles::kMost) + " numbers of joints");
  require(std::all_of(joints.begin(), joints.end(), is_in_range), "joints",
          "must be numbers of joints from 0 to " + std::to_string(kMostBoardJoints - 1));
  require(std::is_sorted(joints.begin(), joints.end()) &&
              std::adjacent_find(joints.begin(), joints.end()) == joints.end(),
          "joints", "must be in ascending order");
  require(params.lowest_deg.size() == joints.size() && params.highest_deg.size() == joints.size(),
          "joints", "must be as many as the limits of joints");
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const double lowest = params.lowest_deg[i];
    const double highest = params.highest_deg[i];
    require(std::isfinite(lowest) && std::isfinite(highest) && lowest < highest, "joints",
            "must have limits, the lowest below the highest: joint " + std::to_string(joints[i]));
  }
}

}  // namespace

void check(const YarpParams& params) {
  require(!params.host.empty(), "host", "must name the machine of the name server");
  require_between(params.port, 1, 65535, "port");
  require(is_port_name(params.robot) && params.robot.front() == '/' && params.robot.back() != '/',
          "robot", "must be the prefix of the robot's port names, such as \"/icub\"");
  require(is_port_name(params.part) && params.part.front() != '/' && params.part.back() != '/',
          "part", "must be a part of the robot, such as \"right_arm\"");
  require(is_port_name(params.local_name) && params.local_name.find('/') == std::string::npos,
          "local_name", "must be a word");
  check_joints(params);
  require_between(params.silent_ms, 40, 1000, "silent_ms");
  require_between(params.connect_timeout_ms, 10, 60'000, "connect_timeout_ms");
  require_between(params.answer_timeout_ms, 10, 60'000, "answer_timeout_ms");
  require_between(params.retry_ms, 10, 5000, "retry_ms");
  require_between(params.check_modes_ms, 10, 10'000, "check_modes_ms");
  require_between(params.start_within_deg, 0.1, 10, "start_within_deg");
  require_between(params.max_step_deg, 0.1, 10, "max_step_deg");
}

}  // namespace puck
