#include "common/motion/joint_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace puck {
namespace {

constexpr std::size_t kLeastControls = 4;
constexpr std::size_t kMostControls = 1000;

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument("joint table: " + why);
}

bool is_limit(double value) { return std::isfinite(value) && value > 0; }

// Bézier coefficients of a cubic spline's pieces; their hull is tighter than that of the spline's
// own.
std::vector<double> hull_of_cubic(const std::vector<double>& c) {
  std::vector<double> hull;
  for (std::size_t i = 0; i + 3 < c.size(); ++i) {
    hull.insert(hull.end(),
                {(c[i] + 4 * c[i + 1] + c[i + 2]) / 6, (2 * c[i + 1] + c[i + 2]) / 3,
                 (c[i + 1] + 2 * c[i + 2]) / 3, (c[i + 1] + 4 * c[i + 2] + c[i + 3]) / 6});
  }
  return hull;
}

std::vector<double> hull_of_quadratic(const std::vector<double>& c) {
  std::vector<double> hull;
  for (std::size_t i = 0; i + 2 < c.size(); ++i) {
    hull.insert(hull.end(), {(c[i] + c[i + 1]) / 2, c[i + 1], (c[i + 1] + c[i + 2]) / 2});
  }
  return hull;
}

// Coefficients of a spline's derivative.
std::vector<double> differences_of(const std::vector<double>& c, double knot_distance) {
  std::vector<double> differences;
  for (std::size_t i = 0; i + 1 < c.size(); ++i) {
    differences.push_back((c[i + 1] - c[i]) / knot_distance);
  }
  return differences;
}

double most_of(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

void check(const LineJoint& joint, const std::string& name, std::size_t controls) {
  if (joint.control_deg.size() != controls) {
    refuse(name + " has " + std::to_string(joint.control_deg.size()) +
           " control points, the first joint " + std::to_string(controls));
  }
  const MotionLimits& limits = joint.limits;
  if (!std::isfinite(limits.lowest) || !std::isfinite(limits.highest) ||
      !(limits.lowest < limits.highest) || !is_limit(limits.velocity) ||
      !is_limit(limits.acceleration) || !is_limit(limits.jerk)) {
    refuse(name +
           " needs finite limits with lowest < highest, and a velocity, acceleration and jerk "
           "above 0");
  }
  for (const double deg : hull_of_cubic(joint.control_deg)) {
    if (!(deg >= limits.lowest && deg <= limits.highest)) {
      refuse(name + " leaves its limits along the line: it goes to " + std::to_string(deg) +
             " deg");
    }
  }
}

// Least slope of one joint along the whole line, so that the encoders determine the place.
constexpr double kLeastSlopeDegPerM = 1;

}  // namespace

JointTable::JointTable(const JointTableParams& params) : params_(params) {
  if (!std::isfinite(params_.from_m) || !std::isfinite(params_.to_m) ||
      !(params_.from_m < params_.to_m)) {
    refuse("from_m and to_m must be finite, with from_m < to_m");
  }
  if (params_.joints.empty() || params_.joints.size() > kMostJoints) {
    refuse("needs 1 to " + std::to_string(kMostJoints) + " joints, got " +
           std::to_string(params_.joints.size()));
  }
  const std::size_t controls = params_.joints.front().control_deg.size();
  if (controls < kLeastControls || controls > kMostControls) {
    refuse("a joint needs 4 to 1000 control points, got " + std::to_string(controls));
  }
  intervals_ = controls - 3;
  bool tells_place = false;
  for (std::size_t k = 0; k < size(); ++k) {
    check(params_.joints[k], "joint_" + std::to_string(k), controls);
    const double h = knot_distance_m();
    const std::vector<double> first = differences_of(params_.joints[k].control_deg, h);
    const std::vector<double> second = differences_of(first, h);
    const std::vector<double> slopes = hull_of_quadratic(first);
    bounds_.push_back({most_of(slopes), most_of(second), most_of(differences_of(second, h))});
    const auto [least, most] = std::minmax_element(slopes.begin(), slopes.end());
    is_monotone_.push_back(*least >= 0 || *most <= 0);
    tells_place = tells_place || *least >= kLeastSlopeDegPerM || *most <= -kLeastSlopeDegPerM;
  }
  if (!tells_place) {
    refuse(
        "no joint grows or falls all along the line by at least 1 deg/m, so the encoders could "
        "not tell where on it the arm is");
  }
  control_deg_.reserve(controls * size());
  for (std::size_t i = 0; i < controls; ++i) {
    for (const LineJoint& joint : params_.joints) control_deg_.push_back(joint.control_deg[i]);
  }
}

double JointTable::knot_distance_m() const {
  return (params_.to_m - params_.from_m) / static_cast<double>(intervals_);
}

void JointTable::at(double y_m, std::span<double> deg) const {
  std::array<double, kMostJoints> slope{};
  at_with_slope(y_m, deg, slope);
}

void JointTable::at_with_slope(double y_m, std::span<double> deg,
                               std::span<double> deg_per_m) const {
  const double h = knot_distance_m();
  const double place = (std::clamp(y_m, params_.from_m, params_.to_m) - params_.from_m) / h;
  const std::size_t interval = std::min(static_cast<std::size_t>(place), intervals_ - 1);
  const double t = place - static_cast<double>(interval);
  const double u = 1 - t;
  const std::array<double, 4> weight{u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
                                     (4 - 6 * u * u + 3 * u * u * u) / 6, t * t * t / 6};
  const std::array<double, 4> slope{-u * u / (2 * h), (-4 * t + 3 * t * t) / (2 * h),
                                    (4 * u - 3 * u * u) / (2 * h), t * t / (2 * h)};
  const double* control = &control_deg_[interval * size()];
  for (std::size_t k = 0; k < size(); ++k) {
    deg[k] = 0;
    deg_per_m[k] = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      deg[k] += weight[i] * control[i * size() + k];
      deg_per_m[k] += slope[i] * control[i * size() + k];
    }
  }
}

LinePlace JointTable::place_of(std::span<const double> deg) const {
  constexpr int kLooks = 64;
  double best_m = params_.from_m;
  double best = std::numeric_limits<double>::infinity();
  std::array<double, kMostJoints> there{};
  for (int i = 0; i <= kLooks; ++i) {
    const double y_m = params_.from_m + (params_.to_m - params_.from_m) * i / kLooks;
    at(y_m, there);
    double squares = 0;
    for (std::size_t k = 0; k < size(); ++k) squares += (deg[k] - there[k]) * (deg[k] - there[k]);
    if (squares >= best) continue;
    best = squares;
    best_m = y_m;
  }
  return place_near(best_m, deg);
}

LinePlace JointTable::place_near(double y_m, std::span<const double> deg) const {
  // Gauss-Newton: the curve is nearly linear over the distance between two readings.
  constexpr int kMostSteps = 20;
  constexpr double kCloseEnoughM = 1e-9;
  std::array<double, kMostJoints> there{};
  std::array<double, kMostJoints> slope{};
  y_m = std::clamp(y_m, params_.from_m, params_.to_m);
  for (int i = 0; i < kMostSteps; ++i) {
    at_with_slope(y_m, there, slope);
    double along = 0;
    double squares = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      along += slope[k] * (deg[k] - there[k]);
      squares += slope[k] * slope[k];
    }
    const double before_m = y_m;
    y_m = std::clamp(y_m + along / squares, params_.from_m, params_.to_m);
    if (std::abs(y_m - before_m) < kCloseEnoughM) break;
  }
  at(y_m, there);
  LinePlace place{y_m, 0};
  for (std::size_t k = 0; k < size(); ++k) {
    place.off_deg = std::max(place.off_deg, std::abs(deg[k] - there[k]));
  }
  return place;
}

MotionLimits JointTable::line_limits(const MotionLimits& wanted) const {
  MotionLimits line = wanted;
  const auto keep = [](double& value, double least, double slope) {
    if (slope > 0) value = std::min(value, least / slope);
  };
  for (std::size_t k = 0; k < size(); ++k) {
    const MotionLimits& joint = limits(k);
    const Bounds& f = bounds_[k];
    keep(line.velocity, joint.velocity, f.first);
    if (f.second > 0) {
      line.velocity = std::min(line.velocity, std::sqrt(joint.acceleration / 2 / f.second));
    }
    if (f.third > 0) line.velocity = std::min(line.velocity, std::cbrt(joint.jerk / 4 / f.third));
  }
  const double v = line.velocity;
  for (std::size_t k = 0; k < size(); ++k) {
    const Bounds& f = bounds_[k];
    keep(line.acceleration, limits(k).acceleration - f.second * v * v, f.first);
    keep(line.acceleration, limits(k).jerk / 4, 3 * f.second * v);
  }
  const double a = line.acceleration;
  for (std::size_t k = 0; k < size(); ++k) {
    const Bounds& f = bounds_[k];
    keep(line.jerk, limits(k).jerk - f.third * v * v * v - 3 * f.second * v * a, f.first);
  }
  return line;
}

}  // namespace puck
