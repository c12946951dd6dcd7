#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/motion/jerk_limited_motion.h"

namespace puck {

/// One joint along the robot's line.
struct LineJoint {
  std::string name{};
  MotionLimits limits{};  ///< deg, deg/s, deg/s², deg/s³.
  /// Control points of a cubic B-spline with uniform knots: nearly the joint's angles at uniform
  /// places, with one more point beyond either end.
  std::vector<double> control_deg{};
};

struct JointTableParams {
  double from_m = -0.3;  ///< The line, y in the table frame.
  double to_m = 0.3;
  std::vector<LineJoint> joints{};
};

/// The place on the line that fits some joint angles.
struct LinePlace {
  double y_m = 0;      ///< The closest place, by least squares over the joints.
  double off_deg = 0;  ///< Largest deviation of a joint from its angle there.
};

/// Line position to joint angles and back. Each joint is a cubic spline of y with a continuous
/// second derivative, so that a motion on the line with bounded velocity, acceleration and jerk
/// bounds those of the joint: with q = f(y),
///
///   q̇ = f′ v,   q̈ = f″ v² + f′ a,   q⃛ = f‴ v³ + 3 f″ v a + f′ j.
///
/// A spline lies within the hull of its coefficients, and its derivatives' coefficients are the
/// differences of its own; so the bounds of f, f′, f″ and f‴ are read off them, and a spline whose
/// coefficients are in order is monotone.
class JointTable {
 public:
  static constexpr std::size_t kMostJoints = 16;

  /// Throws std::invalid_argument that names the fault: no line, no joints or more than 16, fewer
  /// than four control points or different numbers of them, numbers that are not finite, a joint
  /// that leaves its limits along the line, or no joint that is monotone along the line, so that
  /// encoders could not determine the place.
  explicit JointTable(const JointTableParams& params);

  const JointTableParams& params() const { return params_; }
  std::size_t size() const { return params_.joints.size(); }
  const MotionLimits& limits(std::size_t joint) const { return params_.joints[joint].limits; }
  /// Whether the joint's angle only grows, or only falls, along the line.
  bool is_monotone(std::size_t joint) const { return is_monotone_[joint]; }

  /// Angles at a place, which is clamped to the line; `deg` must have size() elements.
  void at(double y_m, std::span<double> deg) const;

  /// Searches the whole line; the angles must be finite.
  LinePlace place_of(std::span<const double> deg) const;
  /// Searches near `y_m`: for consecutive readings.
  LinePlace place_near(double y_m, std::span<const double> deg) const;

  /// `wanted` on the line, reduced where a joint would leave its limits somewhere: v so that it
  /// alone takes no more than half of any joint's acceleration and a quarter of its jerk, then a so
  /// that f″ v² + f′ a fits and 3 f″ v a takes no more than a quarter of the jerk, then j so that
  /// the sum fits.
  MotionLimits line_limits(const MotionLimits& wanted) const;

 private:
  struct Bounds {  // of the derivatives' magnitudes along the line: deg/m, deg/m², deg/m³
    double first = 0;
    double second = 0;
    double third = 0;
  };

  double knot_distance_m() const;
  void at_with_slope(double y_m, std::span<double> deg, std::span<double> deg_per_m) const;

  JointTableParams params_;
  std::size_t intervals_ = 0;
  std::vector<double> control_deg_;  // Row-major: a row a place, a column a joint.
  std::vector<Bounds> bounds_;
  std::vector<bool> is_monotone_;
};

}  // namespace puck
