#pragma once

#include <string>

#include "common/events/pixel_mask.h"
#include "common/io/config.h"
#include "common/simulation/simulation_params.h"
#include "services/camera/file_source.h"

namespace puck {

/// What puck-camera is told, key by key as in config/camera.toml.
struct CameraSettings {
  std::string source = "simulated";  ///< simulated, file, log, stdin or tcp.
  /// Whether the events are not of now, however fast they are played.
  bool is_recorded() const { return source == "file" || source == "log"; }
  FileSourceParams file;   ///< Its options are those of all streams of bytes.
  std::string log_prefix;  ///< Of the channels in a log.
  std::string tcp_host = "localhost";
  int tcp_port = 3333;

  std::string pace = "auto";    ///< auto, sensor or arrival.
  double speed = 1;             ///< Sensor time that passes in a unit of host time.
  std::string at_end = "exit";  ///< exit or wait.

  PixelMask hot_pixels;  ///< As the sensor has them: before any rotation.
  bool rotate_180 = false;
  int packet_bytes = 0;             ///< 0: what suits the bus.
  double arrival_limit_mev_s = 40;  ///< What is published on arrival at most; 0: any.
  int flush_us = 250;         ///< Host time that the first event of a packet waits for others.
  int quiet_flush_us = 5000;  ///< The same while there are fewer than EventBatcher::kFew.

  SimulationParams simulation;
  int truth_hz = 1000;
};

/// Throws ConfigError.
CameraSettings read_camera_settings(Config& config);

}  // namespace puck
