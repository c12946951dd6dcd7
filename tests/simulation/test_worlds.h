#pragma once

#include "common/simulation/simulation_params.h"

namespace puck {

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
