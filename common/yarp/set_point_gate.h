#pragma once

#include <optional>
#include <string>

#include "common/control/joint_angles.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// The last look at a set-point before it goes out. A board takes anything, NaN included.
class SetPointGate {
 public:
  explicit SetPointGate(const YarpParams& params) : params_(params) {}

  /// Why it must not go out: not of our joints, not finite, outside the limits; when it is the
  /// first of all, since a refused one or since a restart, too far from the encoders; else, too far
  /// from both these and the set-point before it. Empty: it may.
  std::string refusal(const JointAngles& set_point, const JointAngles& encoders);
  /// The next set-point has to begin at the encoders.
  void restart() { last_.reset(); }

 private:
  std::string why_not(const JointAngles& set_point, const JointAngles& encoders) const;

  const YarpParams& params_;
  std::optional<JointAngles> last_;
};

}  // namespace puck
