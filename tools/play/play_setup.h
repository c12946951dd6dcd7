#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/control/arm_controller.h"
#include "common/io/table_file.h"
#include "common/play/play_bridge.h"
#include "common/simulation/simulation_params.h"
#include "common/vision/puck_pipeline.h"
#include "common/vision/puck_size_model.h"
#include "tools/play/estimate_errors.h"
#include "tools/play/estimate_link.h"
#include "tools/play/frame_tracker.h"

namespace puck {

/// Where estimates come from.
enum class EstimateSource : std::uint8_t {
  kTruth,   ///< From where the puck truly is, with the errors that PUCK makes.
  kEvents,  ///< PUCK, on the events of the simulated camera.
  kFrames,  ///< From where the puck truly is, as a tracker on a camera's pictures sees it.
};

/// All that a game is made of: what the services read from their configuration.
struct PlaySetup {
  SimulationParams world;
  TableCalibration table{Homography({1, 0, 0, 0, 1, 0, 0, 0, 1}), {}};
  PlayBridgeParams bridge;
  ArmControllerParams arm;
  PipelineParams tracker;
  PuckSizeModel size_model;
  EstimateSource source = EstimateSource::kTruth;
  EstimateErrorParams errors;
  FrameTrackerParams frames;
  EstimateLinkParams link;
};

/// The services' defaults, and the calibrations in a folder: simulated_size.toml and
/// simulated_table.toml. Throws ConfigError when one is missing or wrong.
PlaySetup default_setup(const std::filesystem::path& calibration);

/// The opponent shoots as fast as `max_speed_m_s`, at least half as fast. Throws
/// std::invalid_argument outside kMaxSpeedRange.
void set_shot_speed(GameParams& game, double max_speed_m_s);

}  // namespace puck
