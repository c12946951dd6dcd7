#include "services/camera/camera_settings.h"

#include <array>
#include <cmath>
#include <string_view>

#include "common/io/event_file_kind.h"
#include "common/io/event_filter_config.h"
#include "common/messaging/channels.h"
#include "common/messaging/event_packing.h"
#include "common/simulation/visit_parameters.h"
#include "common/yarp/port_query.h"

namespace puck {
namespace {

/// Lets visit_parameters read the keys of a scene below a prefix.
class SceneReader {
 public:
  SceneReader(Config& config, std::string prefix) : config_(config), prefix_(std::move(prefix)) {}

  void read(const char* key, bool& value) { config_.read(prefix_ + key, value); }
  template <typename Number>
  void read(const char* key, Number& value, Number lowest, Number highest) {
    config_.read(prefix_ + key, value, lowest, highest);
  }

 private:
  Config& config_;
  std::string prefix_;
};

void read_scene(Config& config, SimulationParams& simulation) {
  std::string scene;
  config.read("camera.scene", scene);
  if (!scene.empty()) {
    Config file = Config::from_file(scene);
    SceneReader reader(file, "");
    visit_parameters(reader, simulation);
    file.reject_unknown();
  }
  SceneReader reader(config, "simulation.");
  visit_parameters(reader, simulation);
}

void read_file_settings(Config& config, bool is_live, FileSourceParams& file) {
  constexpr std::array<std::string_view, 5> kUnits{"auto", "s", "ms", "us", "ns"};
  constexpr std::array<std::string_view, 3> kEyes{"auto", "left", "right"};
  constexpr double kHighestRate = 1000;
  std::string path;
  config.read("camera.file", path);
  file.file = path;
  config.read_choice("camera.format", file.options.from, kEventFormats);
  config.read_choice("camera.yarp_eye", file.options.yarp_eye, kEyes);
  config.read("camera.width", file.options.sensor.width, 0, SensorSize::kMax);
  config.read("camera.height", file.options.sensor.height, 0, SensorSize::kMax);
  config.read("camera.text_columns", file.options.text_columns);
  config.read_choice("camera.text_unit", file.options.text_unit, kUnits);
  config.read("camera.text_separator", file.options.text_separator);
  constexpr std::int64_t kAutomatic = -1;
  std::int64_t reorder_us = kAutomatic;
  config.read("camera.reorder_us", reorder_us, kAutomatic, EventFileOptions::kMostReorderUs);
  // In a live stream it would delay every event.
  file.options.reorder_us = reorder_us != kAutomatic ? reorder_us
                            : is_live                ? 0
                                                     : EventFileOptions::kUsualReorderUs;
  config.read("camera.loop", file.loop);
  config.read("camera.rate_mev_s", file.rate_mev_s, 0, kHighestRate);
}

std::int64_t read_seconds(Config& config, const char* key) {
  constexpr double kLongest_s = 1e9;
  double seconds = 0;
  config.read(key, seconds, 0, kLongest_s);
  return std::llround(seconds * 1e6);
}

void read_replay_settings(Config& config, CameraSettings& settings) {
  settings.file.start_us = read_seconds(config, "camera.start_s");
  const std::int64_t length_us = read_seconds(config, "camera.seconds");
  if (length_us > 0) settings.file.length_us = length_us;
  ReplayParams& replay = settings.replay;
  config.read("camera.speed", replay.speed, ReplayRequest::kSlowest, ReplayRequest::kFastest);
  config.read("camera.paused", replay.paused);
  config.read("camera.step_us", replay.step_us, std::int64_t{0}, ReplayRequest::kLongestStepUs);
  replay.skip_gaps_us = read_seconds(config, "camera.skip_gaps_s");
}

// Keys that a source without recorded events, or without a pace, would ignore.
void check_replay_keys(const Config& config, const CameraSettings& settings) {
  const auto refuse = [&](bool is_set, const char* key, const char* usual,
                          const std::string& when) {
    if (is_set) config.fail_expected(key, std::string(usual) + " when " + when);
  };
  const FileSourceParams& file = settings.file;
  const ReplayParams& replay = settings.replay;
  if (!settings.is_recorded()) {
    const std::string when =
        "camera.source is \"" + settings.source + "\" and not \"file\" or \"log\"";
    refuse(!file.file.empty(), "camera.file", "\"\"", when);
    refuse(file.loop, "camera.loop", "false", when);
    refuse(file.rate_mev_s != 0, "camera.rate_mev_s", "0", when);
    refuse(file.start_us != 0, "camera.start_s", "0", when);
    refuse(file.length_us != FileSourceParams::kToEnd, "camera.seconds", "0", when);
    refuse(replay.paused, "camera.paused", "false", when);
    refuse(replay.step_us != 0, "camera.step_us", "0", when);
  }
  if (!settings.is_paced()) {
    const std::string when = settings.pace == "auto" ? "camera.source is \"" + settings.source +
                                                           "\" and camera.pace \"auto\""
                                                     : "camera.pace is \"arrival\"";
    refuse(replay.speed != 1, "camera.speed", "1", when);
    refuse(replay.paused, "camera.paused", "false", when);
    refuse(replay.step_us != 0, "camera.step_us", "0", when);
    refuse(replay.skip_gaps_us != 0, "camera.skip_gaps_s", "0", when);
  }
}

void check_simulated(const Config& config, const CameraSettings& settings) {
  if (settings.pace == "arrival") {
    config.fail("camera.pace", "cannot be \"arrival\" for the simulated table");
  }
  // A quarter turn would swap yaw and pitch, whose order in HEAD is fixed.
  if (settings.filter.turn.swaps_axes()) {
    config.fail_expected("camera.rotate_deg", "0 or 180 for the simulated table");
  }
  if (settings.filter.lens) {
    config.fail_expected("camera.undistort",
                         "\"\" for the simulated table, whose camera has no distortion");
  }
}

void read_yarp_settings(Config& config, CameraSettings& settings) {
  config.read("camera.yarp_port", settings.yarp.port);
  config.read("camera.yarp_server", settings.yarp.server_host);
  config.read("camera.yarp_server_port", settings.yarp.server_port, 1, 65535);
  if (!is_port_name(settings.yarp.port) || settings.yarp.port.front() != '/') {
    config.fail("camera.yarp_port", "must be the name of a port, such as \"/atis3/AE:o\"");
  }
}

}  // namespace

CameraSettings read_camera_settings(Config& config) {
  constexpr std::array<std::string_view, 6> kSources{"simulated", "file", "log",
                                                     "stdin",     "tcp",  "yarp"};
  constexpr std::array<std::string_view, 3> kPaces{"auto", "sensor", "arrival"};
  constexpr std::array<std::string_view, 2> kRoles{"client", "server"};
  constexpr std::array<std::string_view, 2> kEnds{"exit", "wait"};
  CameraSettings settings;
  config.read_choice("camera.source", settings.source, kSources);
  read_file_settings(config, settings.is_stream(), settings.file);
  config.read("camera.log_prefix", settings.log_prefix);
  check_prefix(settings.log_prefix, "camera.log_prefix");
  config.read_choice("camera.tcp_role", settings.tcp_role, kRoles);
  config.read("camera.tcp_host", settings.tcp_host);
  config.read("camera.tcp_port", settings.tcp_port, 1, 65535);
  read_yarp_settings(config, settings);
  config.read_choice("camera.pace", settings.pace, kPaces);
  read_replay_settings(config, settings);
  config.read_choice("camera.at_end", settings.at_end, kEnds);
  settings.filter = read_event_filter(config, "camera");
  config.read("camera.packet_bytes", settings.packet_bytes, 0, EventPackerParams::kMaxBytes);
  config.read("camera.arrival_limit_mev_s", settings.arrival_limit_mev_s, 0, 1000);
  config.read("camera.flush_us", settings.flush_us, 50, 100'000);
  config.read("camera.quiet_flush_us", settings.quiet_flush_us, 50, 100'000);
  config.read("camera.truth_hz", settings.truth_hz, 1, 10'000);
  read_scene(config, settings.simulation);

  if (settings.packet_bytes != 0 && settings.packet_bytes < EventPackerParams::kMinBytes) {
    config.fail("camera.packet_bytes", "must be 0 or from 256 to 60000");
  }
  if (settings.is_recorded() && settings.file.file.empty()) {
    config.fail("camera.file",
                "must name a recording when camera.source is \"" + settings.source + "\"");
  }
  check_replay_keys(config, settings);
  if (settings.source == "simulated") check_simulated(config, settings);
  if (settings.source == "yarp") {
    if (settings.pace == "sensor") {
      config.fail("camera.pace", "cannot be \"sensor\" for a camera on a YARP port");
    }
    if (settings.file.options.sensor.width == 0 || settings.file.options.sensor.height == 0) {
      config.fail("camera.width",
                  "and camera.height must be set when camera.source is \"yarp\": "
                  "a port does not tell its sensor's size");
    }
  }
  return settings;
}

}  // namespace puck
