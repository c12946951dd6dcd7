#pragma once

#include <span>
#include <string>

#include "common/control/joint_angles.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// The last look at a set-point before it goes out. A board takes anything, NaN included.
class SetPointGate {
 public:
  explicit SetPointGate(const YarpParams& params) : params_(params) {}

  /// Why it must not go out: not of our joints, not finite, outside the limits; or, when it is the
  /// first of all or since a refused one, too far from the encoders. Empty: it may.
  std::string refusal(const JointAngles& set_point, const JointAngles& encoders);

 private:
  std::string why_not(const JointAngles& set_point, const JointAngles& encoders) const;

  const YarpParams& params_;
  bool is_open_ = false;
};

}  // namespace puck
