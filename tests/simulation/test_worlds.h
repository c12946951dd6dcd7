#pragma once

#include <cmath>
#include <cstdint>

#include "common/simulation/puck_physics.h"
#include "common/simulation/simulation_params.h"

namespace puck {

/// Steps of TableGame.
inline constexpr std::int64_t kStepsPerSecond = 1'000'000 / PuckPhysics::kStep_us;

/// The same world at a quarter of the usual image size, for quick tests.
inline SimulationParams small_world(std::int64_t seed = 1) {
  SimulationParams params;
  params.seed = seed;
  params.sensor_size = {320, 240};
  params.camera.focal_px = 370;
  params.autonomous_robot = true;
  return params;
}

inline double speed_of(const DiscState& disc) {
  return std::hypot(disc.velocity.x_m_s, disc.velocity.y_m_s);
}

}  // namespace puck
