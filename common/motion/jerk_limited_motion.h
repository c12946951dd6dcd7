#pragma once

#include <array>
#include <cstddef>

namespace puck {

/// Limits of one coordinate. The caller chooses the unit: m on the robot's line, deg of a joint.
struct MotionLimits {
  double lowest = 0;  ///< Lower end of its range.
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

/// Moves one coordinate to a target that may jump at any moment: in the shortest time that the
/// limits on velocity, acceleration and jerk allow, to rest exactly at the target, never past an
/// end of the range. Copies are independent. No allocation after construction; the same calls give
/// the same bits.
///
/// Method. From a state (v, a) there is one quickest motion to rest. Every other quickest motion to
/// a target has its jerk at the limits, except while it cruises at the highest velocity or
/// accelerates at the highest acceleration. A change of velocity by x, with zero acceleration at
/// both ends, takes T(x) = 2 √(x/J), or x/A + A/J where the acceleration meets its limit, and
/// covers the mean of both velocities times T, since its acceleration is symmetric. A state with a
/// ≠ 0 lies on such a change that began, or will begin, when a = 0: τ = a/J from now under the jerk
/// −J, −a/J under J. Let v′ = v + a·|a|/2J be the velocity once a has been reduced to zero,
/// mirrored so that v′ ≥ 0. Then all motions to a distance d fall into three families. Each has one
/// free parameter, with which the distance increases, so that a root finder determines it:
///
/// - up: to a peak velocity vp ≥ v′, cruise, to rest. vp is the highest velocity, or less when d is
/// short.
/// - ease: when it already brakes (a < 0): brake less, up to an acceleration a1 ≤ 0, then as hard
/// as possible to rest. For targets between the end of full braking and the end of released
/// braking.
/// - back: past the target, to a velocity vp ≤ 0, cruise, to rest. For targets too near to stop at.
///
/// Why it never passes an end: the quickest way to rest from any state of such a motion lies, on
/// either side, within that motion itself or within the quickest way to rest from where the motion
/// was planned. As the first one is planned at rest between the ends, and every target lies between
/// them, by induction no way to rest passes an end.
class JerkLimitedMotion {
 public:
  /// Starts at rest at `start`, clamped to the range. Throws std::invalid_argument unless all
  /// numbers are finite, lowest < highest and the others are positive.
  JerkLimitedMotion(const MotionLimits& limits, double start);

  /// The target is clamped to the range. Returns false, and changes nothing, when it is not finite.
  bool set_target(double target);
  /// Comes to rest as soon as the limits allow, and stays there until the next target.
  void hold();
  /// Sets the state to rest at `position`, whatever the motion was: for a restart. Returns false,
  /// and changes nothing, when it is not finite.
  bool rest_at(double position);

  /// Advances by `dt_s`; does nothing unless it is positive and finite.
  void step(double dt_s);

  const MotionState& state() const { return state_; }
  const MotionLimits& limits() const { return limits_; }
  /// The position at which it comes to rest.
  double target() const { return target_; }
  bool is_at_rest() const { return next_ == count_; }
  /// Time until it rests at its target.
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
  std::size_t next_ = 0;  // Index of the present segment; count_: at rest.
  double in_segment_s_ = 0;
  MotionState segment_start_;
  double mirror_ = 1;  // Sign of the jerks while a motion is planned.
};

}  // namespace puck
