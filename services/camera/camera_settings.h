#pragma once

#include <string>

#include "common/io/config.h"
#include "common/io/event_filter.h"
#include "common/simulation/simulation_params.h"
#include "common/yarp/port_reader.h"
#include "services/camera/file_source.h"
#include "services/camera/replay.h"

namespace puck {

/// Settings of puck-camera, as in config/camera.toml.
struct CameraSettings {
  std::string source = "simulated";  ///< simulated, file, log, stdin, tcp or yarp.
  /// Whether the events were recorded before, at any playing speed.
  bool is_recorded() const { return source == "file" || source == "log"; }
  /// Whether the events come when they happen, from another program.
  bool is_stream() const { return source == "stdin" || source == "tcp" || source == "yarp"; }
  /// Whether events wait for their time; else they are published when they come.
  bool is_paced() const {
    return pace == "sensor" || (pace == "auto" && source != "tcp" && source != "yarp");
  }
  FileSourceParams file;   ///< Its options also hold for streams.
  std::string log_prefix;  ///< Prefix of the channels in a log.

  std::string tcp_role = "client";  ///< client or server.
  std::string tcp_host = "localhost";
  int tcp_port = 3333;
  PortReaderParams yarp{
      .port = "/atis3/AE:o", .server_key = "camera.yarp_server", .local_name = "puck-camera"};

  std::string pace = "auto";  ///< auto, sensor or arrival.
  ReplayParams replay;
  std::string at_end = "exit";  ///< exit or wait.

  EventFilterParams filter;
  int packet_bytes = 0;             ///< 0: automatic, by the bus.
  double arrival_limit_mev_s = 40;  ///< Limit with pace "arrival"; 0: none.
  int flush_us = 250;               ///< Longest wait of a packet's first event, host time.
  int quiet_flush_us = 5000;        ///< The same with fewer than EventBatcher::kFew events.

  SimulationParams simulation;
  int truth_hz = 1000;
};

/// Throws ConfigError.
CameraSettings read_camera_settings(Config& config);

}  // namespace puck
