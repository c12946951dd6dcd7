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
  /// Key arm.simulated_frequency_hz: natural frequency of each joint's critically damped
  /// second-order drive. Its lag at constant speed is 1/(π f): 11 ms.
  double frequency_hz = 30;
  double delay_ms = 2;      ///< Key arm.simulated_delay_ms: from a set-point to the drive.
  double backlash_deg = 0;  ///< Key arm.simulated_backlash_deg: play between drive and joint.
};

/// Simulated joints with a transport delay, a critically damped second-order drive, a speed limit
/// and backlash. Modelled by joint and not on the line, since a robot's limits, delays and backlash
/// are those of its joints, and a back end is commanded by joint. The caller gives the time.
class SimulatedBackEnd : public ArmBackEnd {
 public:
  /// Starts at rest at `start`. Throws std::invalid_argument that names the key when a value is out
  /// of its range.
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
    std::int64_t at_us = 0;  // time of arrival at the drives
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
  // Ring of set-points on their way to the drives.
  std::array<Command, 256> waiting_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::optional<std::int64_t> now_us_;
  std::string fault_;
};

}  // namespace puck
