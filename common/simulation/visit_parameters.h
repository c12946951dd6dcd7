#pragma once

#include <cstdint>

#include "common/simulation/simulation_params.h"

namespace puck {

/// Passes every key of a scene with its range to a reader: `reader.read(key, value, lowest,
/// highest)` for numbers, `reader.read(key, value)` for switches. A configuration reads a scene
/// from a file with it; `check` tests the same ranges.
template <typename Reader>
void visit_parameters(Reader& reader, SimulationParams& params) {
  constexpr std::int64_t kMaxSeed = 1'000'000'000'000;
  reader.read("world.seed", params.seed, std::int64_t{0}, kMaxSeed);
  reader.read("world.slice_us", params.slice_us, std::int64_t{25}, std::int64_t{10'000});
  reader.read("world.moving_camera", params.moving_camera);
  reader.read("world.autonomous_robot", params.autonomous_robot);

  TableGeometry& table = params.table;
  reader.read("table.length_m", table.length_m, 1.0, 5.0);
  reader.read("table.width_m", table.width_m, 0.5, 3.0);
  reader.read("table.goal_width_m", table.goal_width_m, 0.05, 2.0);
  reader.read("table.puck_radius_m", table.puck_radius_m, 0.01, 0.1);
  reader.read("table.mallet_radius_m", table.mallet_radius_m, 0.01, 0.1);
  reader.read("table.robot_line_x_m", table.robot_line_x_m, 0.05, 0.5);
  reader.read("table.robot_line_half_m", table.robot_line_half_m, 0.01, 1.5);

  CameraParams& camera = params.camera;
  reader.read("camera.width_px", params.sensor_size.width, 32, SensorSize::kMax);
  reader.read("camera.height_px", params.sensor_size.height, 32, SensorSize::kMax);
  reader.read("camera.focal_px", camera.focal_px, 50.0, 5000.0);
  reader.read("camera.behind_m", camera.behind_m, 0.0, 3.0);
  reader.read("camera.height_m", camera.height_m, 0.1, 5.0);
  reader.read("camera.pitch_deg", camera.pitch_deg, 5.0, 89.0);

  HeadMotionParams& head = params.head_motion;
  reader.read("head.yaw_peak_to_peak_deg", head.yaw_peak_to_peak_deg, 0.0, 30.0);
  reader.read("head.yaw_period_s", head.yaw_period_s, 0.2, 60.0);
  reader.read("head.pitch_peak_to_peak_deg", head.pitch_peak_to_peak_deg, 0.0, 15.0);
  reader.read("head.pitch_period_s", head.pitch_period_s, 0.2, 60.0);
  reader.read("head.roll_peak_to_peak_deg", head.roll_peak_to_peak_deg, 0.0, 15.0);
  reader.read("head.roll_period_s", head.roll_period_s, 0.2, 60.0);
  reader.read("head.vibration_deg", head.vibration_deg, 0.0, 1.0);
  reader.read("head.vibration_hz", head.vibration_hz, 0.1, 50.0);

  EventSensorParams& sensor = params.sensor;
  reader.read("sensor.threshold", sensor.threshold, 0.02, 2.0);
  reader.read("sensor.threshold_mismatch", sensor.threshold_mismatch, 0.0, 0.5);
  reader.read("sensor.cutoff_hz", sensor.cutoff_hz, 10.0, 100'000.0);
  reader.read("sensor.cutoff_luminance", sensor.cutoff_luminance, 0.0, 10.0);
  reader.read("sensor.refractory_us", sensor.refractory_us, 0.0, 10'000.0);
  reader.read("sensor.noise_hz", sensor.noise_hz, 0.0, 100.0);
  reader.read("sensor.hot_pixel_fraction", sensor.hot_pixel_fraction, 0.0, 0.01);
  reader.read("sensor.hot_pixel_hz", sensor.hot_pixel_hz, 0.0, 10'000.0);
  reader.read("sensor.jitter_us", sensor.jitter_us, 0.0, 1000.0);
  reader.read("sensor.readout_mev_s", sensor.readout_mev_s, 0.01, 1000.0);

  LightParams& light = params.light;
  reader.read("light.illuminance_lux", light.illuminance_lux, 1.0, 100'000.0);
  reader.read("light.flicker_modulation", light.flicker_modulation, 0.0, 0.9);
  reader.read("light.flicker_hz", light.flicker_hz, 10.0, 1000.0);

  SceneParams& scene = params.scene;
  constexpr double kDarkest = 0.001;
  constexpr double kBrightest = 10;
  reader.read("scene.table_luminance", scene.table_luminance, kDarkest, kBrightest);
  reader.read("scene.line_luminance", scene.line_luminance, kDarkest, kBrightest);
  reader.read("scene.star_luminance", scene.star_luminance, kDarkest, kBrightest);
  reader.read("scene.rail_luminance", scene.rail_luminance, kDarkest, kBrightest);
  reader.read("scene.goal_luminance", scene.goal_luminance, kDarkest, kBrightest);
  reader.read("scene.puck_luminance", scene.puck_luminance, kDarkest, kBrightest);
  reader.read("scene.puck_side_luminance", scene.puck_side_luminance, 0.0, kBrightest);
  reader.read("scene.puck_print_luminance", scene.puck_print_luminance, 0.0, kBrightest);
  reader.read("scene.mallet_luminance", scene.mallet_luminance, kDarkest, kBrightest);
  reader.read("scene.skin_luminance", scene.skin_luminance, kDarkest, kBrightest);
  reader.read("scene.robot_luminance", scene.robot_luminance, kDarkest, kBrightest);
  reader.read("scene.floor_luminance", scene.floor_luminance, kDarkest, kBrightest);
  reader.read("scene.floor_contrast", scene.floor_contrast, 0.0, 3.0);
  reader.read("scene.wall_luminance", scene.wall_luminance, kDarkest, kBrightest);
  reader.read("scene.logo_luminance", scene.logo_luminance, kDarkest, kBrightest);
  reader.read("scene.logo_count", scene.logo_count, 0, SceneParams::kMostLogos);
  reader.read("scene.logo_radius_m", scene.logo_radius_m, 0.005, 0.06);
  reader.read("scene.line_width_m", scene.line_width_m, 0.0, 0.2);
  reader.read("scene.circle_radius_m", scene.circle_radius_m, 0.0, 1.0);
  reader.read("scene.goal_arc_radius_m", scene.goal_arc_radius_m, 0.0, 1.0);
  reader.read("scene.star_radius_m", scene.star_radius_m, 0.0, 0.3);
  reader.read("scene.rail_width_m", scene.rail_width_m, 0.0, 0.5);
  reader.read("scene.puck_height_m", scene.puck_height_m, 0.0, 0.05);
  reader.read("scene.puck_print_radius_m", scene.puck_print_radius_m, 0.001, 0.06);
  reader.read("scene.puck_print_width_m", scene.puck_print_width_m, 0.0005, 0.06);
  reader.read("scene.mallet_height_m", scene.mallet_height_m, 0.0, 0.07);
  reader.read("scene.table_height_m", scene.table_height_m, 0.1, 2.0);

  PhysicsParams& physics = params.physics;
  reader.read("physics.damping_1_s", physics.damping_1_s, 0.0, 10.0);
  reader.read("physics.rail_normal_keep", physics.rail_normal_keep, 0.1, 1.0);
  reader.read("physics.rail_tangential_keep", physics.rail_tangential_keep, 0.1, 1.0);
  reader.read("physics.mallet_restitution", physics.mallet_restitution, 0.0, 1.0);
  reader.read("physics.max_speed_m_s", physics.max_speed_m_s, 0.5, 30.0);

  GameParams& game = params.game;
  reader.read("game.shot_speed_min_m_s", game.shot_speed_min_m_s, 0.3, 15.0);
  reader.read("game.shot_speed_max_m_s", game.shot_speed_max_m_s, 0.3, 15.0);
  reader.read("game.bank_share", game.bank_share, 0.0, 1.0);
  reader.read("game.aim_error_deg", game.aim_error_deg, 0.0, 30.0);
  reader.read("game.wait_min_s", game.wait_min_s, 0.0, 10.0);
  reader.read("game.wait_max_s", game.wait_max_s, 0.0, 10.0);
  reader.read("game.rest_probability", game.rest_probability, 0.0, 1.0);
  reader.read("game.rest_min_s", game.rest_min_s, 0.0, 60.0);
  reader.read("game.rest_max_s", game.rest_max_s, 0.0, 60.0);
  reader.read("game.reach_probability", game.reach_probability, 0.0, 1.0);
  reader.read("game.reach_min_s", game.reach_min_s, 0.0, 60.0);
  reader.read("game.reach_max_s", game.reach_max_s, 0.0, 60.0);
  reader.read("game.second_puck_speed_m_s", game.second_puck_speed_m_s, 0.0, 5.0);
  reader.read("game.serve_after_s", game.serve_after_s, 0.0, 60.0);
  reader.read("game.served_at_start", game.served_at_start);
  reader.read("game.stuck_after_s", game.stuck_after_s, 0.5, 60.0);

  SimulatedArmParams& arm = params.arm;
  reader.read("arm.max_speed_m_s", arm.max_speed_m_s, 0.01, 10.0);
  reader.read("arm.max_acceleration_m_s2", arm.max_acceleration_m_s2, 0.1, 500.0);
  reader.read("arm.max_jerk_m_s3", arm.max_jerk_m_s3, 1.0, 100000.0);
}

}  // namespace puck
