#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/control/arm_back_end.h"
#include "common/motion/joint_table.h"

namespace puck {

struct SimulatedBackEndParams {
  /// Key arm.simulated_frequency_hz: of each joint's second-order drive, critically damped. It
  /// follows a steady motion 1/(π f) behind: 11 ms.
  double frequency_hz = 30;
  double delay_ms = 2;      ///< Key arm.simulated_delay_ms: from a set-point to the drive.
  double backlash_deg = 0;  ///< Key arm.simulated_backlash_deg: play between drive and joint.
};

/// Joints that follow their set-points as a robot's do: late, each as a critically damped
/// second-order drive no faster than its limit, and with play. By joint and not on the line, since
/// that is where a robot has its limits, delay and play, and where a back end is commanded; the
/// place on the line follows from them as on the robot. Its time is the caller's.
class SimulatedBackEnd : public ArmBackEnd {
 public:
  /// The joints rest at `start`. Throws std::invalid_argument that names the key when a value is
  /// out of its range.
  SimulatedBackEnd(const SimulatedBackEndParams& params, const JointTable& table,
                   const JointAngles& start);

  std::string_view name() const override { return "simulated"; }
  void command(const JointAngles& set_point, std::int64_t monotonic_us) override;
  std::optional<JointReading> reading(std::int64_t monotonic_us) override;
  std::string fault(std::int64_t) override { return fault_; }

 private:
  struct Drive {
    double deg = 0;
    double deg_s = 0;
  };
  struct Command {
    JointAngles deg;
    std::int64_t at_us = 0;  // when it reaches the drives
  };

  void advance(std::int64_t monotonic_us);
  void small_step(double dt_s);

  double omega_1_s_;
  std::int64_t delay_us_;
  double half_play_deg_;
  std::vector<MotionLimits> limits_;
  std::array<Drive, JointAngles::kMost> drives_{};
  JointAngles joints_;
  JointAngles input_;
  // On their way: a ring.
  std::array<Command, 256> waiting_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::optional<std::int64_t> now_us_;
  std::string fault_;
};

}  // namespace puck
