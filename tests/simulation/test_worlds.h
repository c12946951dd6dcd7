#pragma once

#include <cstdint>

#include "common/simulation/puck_physics.h"
#include "common/simulation/simulation_params.h"

namespace puck {

/// Of TableGame.
inline constexpr std::int64_t kStepsPerSecond = 1'000'000 / PuckPhysics::kStep_us;

/// A quarter of the usual picture of the same world, so that tests stay quick.
inline SimulationParams small_world(std::int64_t seed = 1) {
  SimulationParams params;
  params.seed = seed;
  params.sensor_size = {320, 240};
  params.camera.focal_px = 370;
  params.autonomous_robot = true;
  return params;
}

}  // namespace puck
