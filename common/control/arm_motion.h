#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/control/arm_back_end.h"
#include "common/control/encoder_watch.h"
#include "common/control/joint_guard.h"
#include "common/control/steady_start.h"
#include "common/motion/jerk_limited_motion.h"
#include "common/motion/joint_table.h"
#include "common/motion/simulated_joints.h"

namespace puck {

struct ArmMotionParams {
  // Limits of the mallet on the line; lowered where a joint's limits require it.
  double max_speed_m_s = 1.5;
  double max_acceleration_m_s2 = 20;
  double max_jerk_m_s3 = 2000;
  JointTableParams joints = simulated_joints();
  /// Key arm.approach_deg_s: speed of the joint with the longest way during the approach.
  double approach_deg_s = 10;
  /// Key arm.max_tracking_error_deg: a joint further from its set-point is a fault.
  double max_tracking_error_deg = 10;
  std::int64_t max_encoder_age_us = 100'000;  ///< Key arm.max_encoder_age_ms.
};

/// Turns targets on the line into safe set-points of the joints: starts at the encoders' position
/// once several readings agree, moves slowly to the line, then on it, within all limits. Checks
/// each set-point again before it is sent, and that the arm follows. One thread.
class ArmMotion {
 public:
  /// `line_half_m`: half length of the mallet's line. Throws std::invalid_argument that names the
  /// key when a value is out of its range or the joint table does not fit.
  ArmMotion(const ArmMotionParams& params, double line_half_m);

  ArmMotion(const ArmMotion&) = delete;
  ArmMotion& operator=(const ArmMotion&) = delete;

  const JointTable& table() const { return table_; }

  /// Advances by `dt_s` towards the target; without a target, brakes to rest within the limits.
  /// Returns what is wrong, else an empty string; after an error the arm comes to rest and the
  /// caller must restart it. Unless it `may_take` joints, it leaves joints alone that the back end
  /// does not hold, and starts again once it may.
  std::string step(ArmBackEnd& back_end, std::optional<double> target_m, std::int64_t monotonic_us,
                   double dt_s, bool may_take);

  /// Starts again from the next encoder readings, after the set-points have come to rest.
  void restart() { wants_restart_ = true; }
  /// Call it when no set-points were sent for so long that the arm rests at the last one.
  void rest();

  /// The position of the joints is not known yet; no set-point is sent.
  bool is_waiting() const { return phase_ == Phase::kWaiting; }
  bool is_on_line() const { return phase_ == Phase::kOnLine; }
  /// No set-point is sent, or always the same one.
  bool set_points_rest() const;
  /// Why the arm is not on the line yet; empty: it is.
  std::string note() const;

  const EncoderWatch& encoders() const { return encoders_; }
  /// Set-point on the line, with velocity and acceleration.
  const JerkLimitedMotion& line() const { return line_; }
  /// The last set-point sent; empty before the first one.
  const JointAngles& set_point() const { return set_point_; }

 private:
  enum class Phase : std::uint8_t { kWaiting, kApproach, kOnLine };

  std::string trouble(ArmBackEnd& back_end, std::int64_t monotonic_us, bool may_take);
  void wait_anew();
  std::string begin();
  void forget_encoders();
  JointAngles next_set_point(std::optional<double> target_m, double dt_s);
  JerkLimitedMotion approach_over(double distance_deg) const;

  ArmMotionParams params_;
  JointTable table_;
  EncoderWatch encoders_;
  SteadyStart start_;
  JointGuard guard_;
  Phase phase_ = Phase::kWaiting;
  bool is_silenced_ = false;  // until it is restarted
  bool wants_restart_ = false;
  std::string awaited_;  // what the back end waits for without encoders
  JerkLimitedMotion line_;
  // Straight in joint space from the start to the line; in deg of the joint with the longest way.
  JerkLimitedMotion approach_;
  JointAngles approach_from_;
  JointAngles approach_to_;
  double approach_deg_ = 0;
  JointAngles set_point_;
};

}  // namespace puck
