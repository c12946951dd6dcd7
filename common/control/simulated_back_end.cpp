#include "common/control/simulated_back_end.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace puck {
namespace {

constexpr std::int64_t kLongestStepUs = 1000;
// After a longer pause the drives have long come to rest.
constexpr std::int64_t kLongestPauseUs = 2'000'000;

double in_range(double value, double lowest, double highest, const std::string& key) {
  if (value >= lowest && value <= highest) return value;
  throw std::invalid_argument(key + " must be from " + std::to_string(lowest) + " to " +
                              std::to_string(highest) + ", got " + std::to_string(value));
}

}  // namespace

SimulatedBackEnd::SimulatedBackEnd(const SimulatedBackEndParams& params, const JointTable& table,
                                   const JointAngles& start)
    : omega_1_s_(2 * std::numbers::pi *
                 in_range(params.frequency_hz, 0.1, 1000, "arm.simulated_frequency_hz")),
      delay_us_(std::llround(1e3 * in_range(params.delay_ms, 0, 100, "arm.simulated_delay_ms"))),
      half_play_deg_(in_range(params.backlash_deg, 0, 10, "arm.simulated_backlash_deg") / 2),
      joints_(start),
      input_(start) {
  if (start.size() != table.size()) throw std::invalid_argument("the start needs every joint");
  for (std::size_t k = 0; k < table.size(); ++k) {
    limits_.push_back(table.limits(k));
    drives_[k].deg = start[k];
  }
}

void SimulatedBackEnd::command(const JointAngles& set_point, std::int64_t monotonic_us) {
  bool is_good = set_point.size() == limits_.size();
  for (std::size_t k = 0; is_good && k < limits_.size(); ++k) {
    is_good = set_point[k] >= limits_[k].lowest - 1e-9 && set_point[k] <= limits_[k].highest + 1e-9;
  }
  if (!is_good) {
    fault_ = "the simulated arm got a set-point outside its limits";
    return;
  }
  advance(monotonic_us);
  if (count_ == waiting_.size()) {
    input_ = waiting_[first_].deg;
    first_ = (first_ + 1) % waiting_.size();
    --count_;
  }
  waiting_[(first_ + count_) % waiting_.size()] = {set_point, monotonic_us + delay_us_};
  ++count_;
}

std::optional<JointReading> SimulatedBackEnd::reading(std::int64_t monotonic_us) {
  advance(monotonic_us);
  return JointReading{joints_, *now_us_};
}

void SimulatedBackEnd::advance(std::int64_t monotonic_us) {
  if (!now_us_) now_us_ = monotonic_us;
  now_us_ = std::max(*now_us_, monotonic_us - kLongestPauseUs);
  while (*now_us_ < monotonic_us) {
    while (count_ > 0 && waiting_[first_].at_us <= *now_us_) {
      input_ = waiting_[first_].deg;
      first_ = (first_ + 1) % waiting_.size();
      --count_;
    }
    std::int64_t until_us = std::min(monotonic_us, *now_us_ + kLongestStepUs);
    if (count_ > 0) until_us = std::min(until_us, waiting_[first_].at_us);
    small_step(1e-6 * static_cast<double>(until_us - *now_us_));
    now_us_ = until_us;
  }
}

void SimulatedBackEnd::small_step(double dt_s) {
  const double decay = std::exp(-omega_1_s_ * dt_s);
  for (std::size_t k = 0; k < limits_.size(); ++k) {
    Drive& drive = drives_[k];
    // ẍ + 2 ω ẋ + ω² (x − u) = 0 with a constant u, exactly.
    const double off = drive.deg - input_[k];
    const double mixed = drive.deg_s + omega_1_s_ * off;
    const double moved = (off + mixed * dt_s) * decay - off;
    const double most = limits_[k].velocity * dt_s;
    drive.deg += std::clamp(moved, -most, most);
    drive.deg_s = std::clamp((drive.deg_s - omega_1_s_ * mixed * dt_s) * decay,
                             -limits_[k].velocity, limits_[k].velocity);
    joints_[k] = std::clamp(joints_[k], drive.deg - half_play_deg_, drive.deg + half_play_deg_);
  }
}

}  // namespace puck
