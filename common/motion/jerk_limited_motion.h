#pragma once

#include <array>
#include <cstddef>

namespace puck {

/// Of one coordinate. The unit of place is the caller's: m on the robot's line, deg of a joint.
struct MotionLimits {
  double lowest = 0;  ///< The ends between which it stays.
  double highest = 0;
  double velocity = 0;      ///< Unit/s.
  double acceleration = 0;  ///< Unit/s².
  double jerk = 0;          ///< Unit/s³.
};

struct MotionState {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;
};

/// Moves one coordinate to a target that may jump at any moment: in the shortest time that its
/// limits on velocity, acceleration and jerk allow, to rest exactly there, and never past an end.
/// Copies are independent. No allocation after construction; the same calls give the same bits.
///
/// How. Rest can be reached from a state (v, a) in one way that is quickest, and every other motion
/// to a target is quickest with the jerk at its limits but for a cruise at the highest velocity or
/// stretches at the highest acceleration. A change of velocity by x, from and to an acceleration of
/// zero, takes T(x) = 2 √(x/J), or x/A + A/J where the acceleration meets its limit, and covers the
/// mean of both velocities times T, since its acceleration is symmetric. A state with a ≠ 0 lies on
/// such a change that began, or will begin, when a = 0: τ = a/J from now under the jerk −J, −a/J
/// under J. So with v′ = v + a·|a|/2J, the velocity left once a is let go, and mirrored so that
/// v′ ≥ 0, all motions to a distance d fall into three families, each with one free parameter that
/// the distance covered grows with, so that it is found by bisection's faster kin:
///
///  - up: to a peak velocity vp ≥ v′, cruise, to rest. vp is the highest velocity, or less when d
///    is short.
///  - ease: while it brakes already (a < 0): brake less, up to an acceleration a1 ≤ 0, then as hard
///    as possible to rest. For targets between where braking on and letting go would end.
///  - back: past the target, to a velocity vp ≤ 0, cruise, to rest. For what is too near to stop
///  at.
///
/// Why it never passes an end: the quickest way to rest from any state of such a motion lies, on
/// either side, within that motion itself or within the quickest way to rest from where the motion
/// was planned. As the first one is planned at rest between the ends, and every target lies between
/// them, by induction no way to rest passes an end.
class JerkLimitedMotion {
 public:
  /// At rest at `start`, which is moved to the nearer end when it lies outside. Throws
  /// std::invalid_argument unless all numbers are finite, lowest < highest and the rest positive.
  JerkLimitedMotion(const MotionLimits& limits, double start);

  /// A target beyond an end is that end. One that is not finite is refused with false, and changes
  /// nothing.
  bool set_target(double target);
  /// Comes to rest as soon as the limits allow, until the next target.
  void hold();
  /// At rest there from now on, whatever the motion was: for one that begins anew. False, and
  /// nothing changed, when it is not finite.
  bool rest_at(double position);

  /// Moves on by `dt_s`; nothing happens unless it is positive and finite.
  void step(double dt_s);

  const MotionState& state() const { return state_; }
  const MotionLimits& limits() const { return limits_; }
  /// Where it comes to rest.
  double target() const { return target_; }
  bool is_at_rest() const { return next_ == count_; }
  /// Until it rests at its target.
  double time_left_s() const;

 private:
  struct Segment {
    double duration_s = 0;
    double jerk = 0;
  };

  void plan(double distance);
  void plan_up(double velocity, double acceleration, double distance);
  double plan_rest(double velocity, double acceleration);
  void plan_ease(double velocity, double acceleration, double distance);
  void plan_back(double velocity, double acceleration, double distance);
  void add(double duration_s, double jerk);
  void add_change(double jerk, double change, double already_s);
  double peak_acceleration(double change) const;
  double change_time(double change) const;
  double change_distance(double from, double to) const;

  MotionLimits limits_;
  MotionState state_;
  double target_ = 0;
  bool holding_ = false;

  std::array<Segment, 8> segments_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;  // the segment that it is in; count_: at rest
  double in_segment_s_ = 0;
  MotionState segment_start_;
  double mirror_ = 1;  // of the jerks while a plan is made
};

}  // namespace puck
