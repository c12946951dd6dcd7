#pragma once

#include <cstdint>

#include "common/events/sensor_size.h"
#include "common/simulation/camera_params.h"
#include "common/simulation/event_sensor_params.h"
#include "common/simulation/game_params.h"
#include "common/simulation/head_motion_params.h"
#include "common/simulation/light_params.h"
#include "common/simulation/physics_params.h"
#include "common/simulation/scene_params.h"
#include "common/simulation/simulated_arm_params.h"
#include "common/table/table_geometry.h"

namespace puck {

/// All parameters of a simulated world. The same parameters give the same events, to the bit.
struct SimulationParams {
  std::int64_t seed = 1;
  /// Sensor time of one `advance`. The camera's pose and slow objects are drawn once a slice, fast
  /// objects as often as needed.
  std::int64_t slice_us = 500;
  SensorSize sensor_size{640, 480};
  bool moving_camera = false;     ///< The head moves as in `head_motion`; else it stays at home.
  bool autonomous_robot = false;  ///< The world plays the robot; else `set_robot_mallet` does.

  TableGeometry table;
  CameraParams camera;
  HeadMotionParams head_motion;
  EventSensorParams sensor;
  LightParams light;
  SceneParams scene;
  PhysicsParams physics;
  GameParams game;
  SimulatedArmParams arm;  ///< Arm of the autonomous robot.
};

/// Throws std::invalid_argument with a line such as
/// `camera.focal_px must be between 50 and 5000, got -1`.
void check(const SimulationParams& params);

}  // namespace puck
