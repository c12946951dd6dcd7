#include "common/motion/jerk_limited_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

MotionState after(const MotionState& from, double jerk, double s) {
  return {from.position + s * (from.velocity + s * (from.acceleration / 2 + s * jerk / 6)),
          from.velocity + s * (from.acceleration + s * jerk / 2), from.acceleration + s * jerk};
}

// Root of an increasing f between `low` and `high`, to the last bits of a double, by Chandrupatla's
// method: inverse quadratic steps where f is smooth, bisection elsewhere.
template <typename Function>
double root_between(double low, double high, const Function& f) {
  double f_low = f(low);
  double f_high = f(high);
  if (f_low >= 0) return low;
  if (f_high <= 0) return high;
  // b: the newest point, a: the one across the root, c: the previous one.
  double a = high, f_a = f_high, b = low, f_b = f_low, c = high, f_c = f_high;
  double share = 0.5;
  constexpr int kMost = 100;
  for (int i = 0; i < kMost; ++i) {
    const double x = a + share * (b - a);
    const double f_x = f(x);
    if ((f_x > 0) == (f_a > 0)) {
      c = a;
      f_c = f_a;
    } else {
      c = b;
      f_c = f_b;
      b = a;
      f_b = f_a;
    }
    a = x;
    f_a = f_x;
    const double best = std::abs(f_a) < std::abs(f_b) ? a : b;
    const double tolerance = 2 * std::numeric_limits<double>::epsilon() * std::abs(best) + 1e-300;
    if (f_x == 0 || std::abs(b - a) <= 2 * tolerance) return best;
    const double least = tolerance / std::abs(b - a);
    const double xi = (a - b) / (c - b);
    const double phi = (f_a - f_b) / (f_c - f_b);
    share = 0.5;
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi) {
      share = f_a / (f_b - f_a) * f_c / (f_b - f_c) +
              (c - a) / (b - a) * f_a / (f_c - f_a) * f_b / (f_c - f_b);
    }
    share = std::clamp(share, least, 1 - least);
  }
  return std::abs(f_a) < std::abs(f_b) ? a : b;
}

}  // namespace

JerkLimitedMotion::JerkLimitedMotion(const MotionLimits& limits, double start) : limits_(limits) {
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!std::isfinite(limits.lowest) || !std::isfinite(limits.highest) || !std::isfinite(start) ||
      !(limits.lowest < limits.highest) || !is_positive(limits.velocity) ||
      !is_positive(limits.acceleration) || !is_positive(limits.jerk)) {
    throw std::invalid_argument(
        "a motion needs finite limits with lowest < highest, and a velocity, acceleration and jerk "
        "above 0");
  }
  rest_at(start);
}

bool JerkLimitedMotion::set_target(double target) {
  if (!std::isfinite(target)) return false;
  target = std::clamp(target, limits_.lowest, limits_.highest);
  if (target == target_ && !holding_) return true;
  holding_ = false;
  target_ = target;
  plan(target_ - state_.position);
  if (is_at_rest()) state_ = {target_, 0, 0};
  return true;
}

void JerkLimitedMotion::hold() {
  if (holding_) return;
  holding_ = true;
  segment_start_ = state_;
  in_segment_s_ = 0;
  count_ = next_ = 0;
  const double v = state_.velocity;
  const double a = state_.acceleration;
  mirror_ = v + a * std::abs(a) / (2 * limits_.jerk) < 0 ? -1 : 1;
  const double distance = plan_rest(mirror_ * v, mirror_ * a);
  target_ = std::clamp(state_.position + mirror_ * distance, limits_.lowest, limits_.highest);
}

bool JerkLimitedMotion::rest_at(double position) {
  if (!std::isfinite(position)) return false;
  target_ = std::clamp(position, limits_.lowest, limits_.highest);
  state_ = segment_start_ = {target_, 0, 0};
  holding_ = false;
  in_segment_s_ = 0;
  count_ = next_ = 0;
  return true;
}

void JerkLimitedMotion::step(double dt_s) {
  if (!(dt_s > 0) || !std::isfinite(dt_s) || is_at_rest()) return;
  in_segment_s_ += dt_s;
  while (next_ < count_ && in_segment_s_ >= segments_[next_].duration_s) {
    const Segment& segment = segments_[next_];
    segment_start_ = after(segment_start_, segment.jerk, segment.duration_s);
    in_segment_s_ -= segment.duration_s;
    ++next_;
  }
  if (is_at_rest()) {
    // Removes the rounding error.
    state_ = {target_, 0, 0};
  } else {
    state_ = after(segment_start_, segments_[next_].jerk, in_segment_s_);
  }
}

double JerkLimitedMotion::time_left_s() const {
  double left_s = -in_segment_s_;
  for (std::size_t i = next_; i < count_; ++i) left_s += segments_[i].duration_s;
  return is_at_rest() ? 0 : left_s;
}

double JerkLimitedMotion::peak_acceleration(double change) const {
  return std::min(std::sqrt(limits_.jerk * change), limits_.acceleration);
}

double JerkLimitedMotion::change_time(double change) const {
  const double peak = peak_acceleration(change);
  return peak > 0 ? change / peak + peak / limits_.jerk : 0;
}

double JerkLimitedMotion::change_distance(double from, double to) const {
  return (from + to) / 2 * change_time(std::abs(to - from));
}

void JerkLimitedMotion::add(double duration_s, double jerk) {
  if (duration_s > 0) segments_[count_++] = {duration_s, mirror_ * jerk};
}

// A change of the velocity that starts with `jerk` and has an acceleration of zero at both ends.
// `already_s` of its first part are already over; a negative value extends that part, so that even
// a change by 0 starts with `jerk`.
void JerkLimitedMotion::add_change(double jerk, double change, double already_s) {
  change = std::max(0.0, change);
  const double peak = peak_acceleration(change);
  add(peak / limits_.jerk - already_s, jerk);
  if (peak >= limits_.acceleration) add(change / peak - peak / limits_.jerk, 0);
  add(peak / limits_.jerk, -jerk);
}

void JerkLimitedMotion::plan(double distance) {
  segment_start_ = state_;
  in_segment_s_ = 0;
  count_ = next_ = 0;
  const double jerk = limits_.jerk;
  mirror_ = 1;
  if (state_.velocity + state_.acceleration * std::abs(state_.acceleration) / (2 * jerk) < 0) {
    mirror_ = -1;
  }
  const double v = mirror_ * state_.velocity;
  const double a = mirror_ * state_.acceleration;
  const double d = mirror_ * distance;

  // Time, distance and velocity at which the acceleration reaches zero under a jerk of −J.
  const double down_s = a / jerk;
  const double down_from = v + a * a / (2 * jerk);
  const double down_at = down_s * (v + jerk * down_s * down_s / 3);
  const double rest_at = down_at + change_distance(down_from, 0);
  if (d < rest_at) return plan_back(v, a, d);
  if (a < 0) {
    const double let_go_s = -a / jerk;
    const double left = std::max(0.0, v - a * a / (2 * jerk));
    const double let_go_at = let_go_s * (v - jerk * let_go_s * let_go_s / 3);
    if (d < let_go_at + change_distance(left, 0)) return plan_ease(v, a, d);
  }
  plan_up(v, a, d);
}

void JerkLimitedMotion::plan_up(double v, double a, double d) {
  const double jerk = limits_.jerk;
  const double up_s = -a / jerk;
  const double from = v - a * a / (2 * jerk);
  const double at = up_s * (v - jerk * up_s * up_s / 3);
  const auto missed = [&](double peak) {
    return at + change_distance(from, peak) + change_distance(peak, 0) - d;
  };
  const double least = std::max(0.0, v + a * std::abs(a) / (2 * jerk));
  const double most = std::max(least, limits_.velocity);
  const double peak = root_between(least, most, missed);
  add_change(jerk, peak - from, -up_s);
  if (peak >= limits_.velocity) add(-missed(peak) / peak, 0);
  add_change(-jerk, peak, 0);
}

double JerkLimitedMotion::plan_rest(double v, double a) {
  const double down_s = a / limits_.jerk;
  const double from = v + a * a / (2 * limits_.jerk);
  add_change(-limits_.jerk, from, -down_s);
  return down_s * (v + limits_.jerk * down_s * down_s / 3) + change_distance(from, 0);
}

void JerkLimitedMotion::plan_ease(double v, double a, double d) {
  const double jerk = limits_.jerk;
  const auto eased = [&](double a1) { return after({0, v, a}, jerk, (a1 - a) / jerk); };
  const auto missed = [&](double a1) {
    const MotionState there = eased(a1);
    const double down_s = a1 / jerk;
    const double from = there.velocity + a1 * a1 / (2 * jerk);
    return there.position + down_s * (there.velocity + jerk * down_s * down_s / 3) +
           change_distance(std::max(0.0, from), 0) - d;
  };
  const double a1 = root_between(a, 0, missed);
  add((a1 - a) / jerk, jerk);
  plan_rest(eased(a1).velocity, a1);
}

void JerkLimitedMotion::plan_back(double v, double a, double d) {
  const double jerk = limits_.jerk;
  const double down_s = a / jerk;
  const double from = v + a * a / (2 * jerk);
  const double at = down_s * (v + jerk * down_s * down_s / 3);
  const auto missed = [&](double peak) {
    return at + change_distance(from, peak) + change_distance(peak, 0) - d;
  };
  const double peak = root_between(-limits_.velocity, 0, missed);
  add_change(-jerk, from - peak, -down_s);
  // Too far even at the highest velocity: cruise for the rest.
  if (peak <= -limits_.velocity) add(missed(peak) / limits_.velocity, 0);
  add_change(jerk, -peak, 0);
}

}  // namespace puck
