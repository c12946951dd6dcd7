#include "common/yarp/set_point_gate.h"

#include <cmath>

#include "common/yarp/in_deg.h"

namespace puck {
std::string SetPointGate::refusal(const JointAngles& set_point, const JointAngles& encoders) {
  std::string why = why_not(set_point, encoders);
  last_.reset();
  if (why.empty()) last_ = set_point;
  return why;
}

std::string SetPointGate::why_not(const JointAngles& set_point, const JointAngles& encoders) const {
  const std::size_t joints = params_.joints.size();
  if (set_point.size() != joints || encoders.size() != joints) {
    return "a set-point of " + std::to_string(set_point.size()) + " joints instead of " +
           std::to_string(joints);
  }
  for (std::size_t i = 0; i < joints; ++i) {
    const double deg = set_point[i];
    const auto refuse = [&](const std::string& why) {
      return "the set-point of joint " + std::to_string(params_.joints[i]) + why;
    };
    if (!std::isfinite(deg)) return refuse(" is not a finite number");
    if (deg < params_.lowest_deg[i] || deg > params_.highest_deg[i]) {
      return refuse(", " + in_deg(deg) + ", is outside its limits");
    }
    if (std::abs(deg - encoders[i]) <= params_.start_within_deg) continue;
    if (!last_) {
      return refuse(", " + in_deg(deg) + ", does not begin at its encoder, " + in_deg(encoders[i]));
    }
    if (!(std::abs(deg - (*last_)[i]) <= params_.max_step_deg)) {
      return refuse(", " + in_deg(deg) + ", is too far from the one before, " +
                    in_deg((*last_)[i]) + ": were set-points held up?");
    }
  }
  return {};
}

}  // namespace puck
