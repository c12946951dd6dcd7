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
  // Of the mallet on the line; less where a joint's limits ask for it.
  double max_speed_m_s = 1.5;
  double max_acceleration_m_s2 = 20;
  double max_jerk_m_s3 = 2000;
  JointTableParams joints = simulated_joints();
  /// Key arm.approach_deg_s: how fast the joint that has furthest to go moves to the line.
  double approach_deg_s = 10;
  /// Key arm.max_tracking_error_deg: a joint further from its set-point is a fault.
  double max_tracking_error_deg = 10;
  std::int64_t max_encoder_age_us = 100'000;  ///< Key arm.max_encoder_age_ms.
};

/// Turns targets on the line into set-points of joints, and keeps them safe: begins where the
/// encoders are, once several readings agree, moves slowly to the line, then on it, never beyond
/// any limit; looks at each set-point once more before it is sent, and at how the arm follows. One
/// thread.
class ArmMotion {
 public:
  /// `line_half_m`: the mallet moves between plus and minus this. Throws std::invalid_argument that
  /// names the key when a value is out of its range, or the joint table does not fit.
  ArmMotion(const ArmMotionParams& params, double line_half_m);

  ArmMotion(const ArmMotion&) = delete;
  ArmMotion& operator=(const ArmMotion&) = delete;

  const JointTable& table() const { return table_; }

  /// Moves on by `dt_s`: towards the target, or, without one, as quickly as its limits allow to
  /// rest. What is wrong, if anything: then the arm comes to rest, and it is for the caller to
  /// restart it. Unless it `may_take` joints, those that the back end does not hold are let be: it
  /// begins anew once it may.
  std::string step(ArmBackEnd& back_end, std::optional<double> target_m, std::int64_t monotonic_us,
                   double dt_s, bool may_take);

  /// Begins anew at what the encoders say next; but first the set-points come to rest, should they
  /// still be on the move.
  void restart() { wants_restart_ = true; }
  /// No set-points were sent for so long that the arm has come to rest at the last one.
  void rest();

  /// It does not know yet where the joints are: nothing is sent.
  bool is_waiting() const { return phase_ == Phase::kWaiting; }
  bool is_on_line() const { return phase_ == Phase::kOnLine; }
  /// Nothing is sent, or the same again and again.
  bool set_points_rest() const;
  /// Why it goes nowhere yet, or is on its way to the line; empty: neither.
  std::string note() const;

  const EncoderWatch& encoders() const { return encoders_; }
  /// The place that is asked for now, and its velocity and acceleration.
  const JerkLimitedMotion& line() const { return line_; }
  /// Sent last; without elements before the first.
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
  std::string awaited_;  // by the back end, while there are no encoders
  JerkLimitedMotion line_;
  // Straight through the joints, from where they were to the line; in deg of the joint that has
  // furthest to go.
  JerkLimitedMotion approach_;
  JointAngles approach_from_;
  JointAngles approach_to_;
  double approach_deg_ = 0;
  JointAngles set_point_;
};

}  // namespace puck
