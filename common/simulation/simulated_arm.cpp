#include "common/simulation/simulated_arm.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

double positive(double value, const std::string& key) {
  if (value > 0 && std::isfinite(value)) return value;
  throw std::invalid_argument(key + " must be more than 0, got " + std::to_string(value));
}

}  // namespace

SimulatedArm::SimulatedArm(const SimulatedArmParams& params, double half_line_m)
    : motion_({-half_line_m, positive(half_line_m, "table.robot_line_half_m"),
               positive(params.max_speed_m_s, "arm.max_speed_m_s"),
               positive(params.max_acceleration_m_s2, "arm.max_acceleration_m_s2"),
               positive(params.max_jerk_m_s3, "arm.max_jerk_m_s3")},
              0) {}

}  // namespace puck
