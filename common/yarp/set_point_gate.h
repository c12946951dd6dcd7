#pragma once

#include <optional>
#include <string>

#include "common/control/joint_angles.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// The last check of a set-point before it is sent. A board accepts anything, NaN included.
class SetPointGate {
 public:
  explicit SetPointGate(const YarpParams& params) : params_(params) {}

  /// Reason for refusing the set-point; empty: none. Refused: another number of joints; not finite;
  /// outside the limits; too far from the encoders, if it is the first one or the first since a
  /// refusal or restart; otherwise, too far from both the encoders and the previous set-point.
  std::string refusal(const JointAngles& set_point, const JointAngles& encoders);
  /// The next set-point must begin at the encoders.
  void restart() { last_.reset(); }

 private:
  std::string why_not(const JointAngles& set_point, const JointAngles& encoders) const;

  const YarpParams& params_;
  std::optional<JointAngles> last_;
};

}  // namespace puck
