#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/control/arm_controller.h"
#include "common/io/table_file.h"
#include "common/play/play_bridge.h"
#include "common/simulation/simulation_params.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/make_pipeline.h"
#include "tools/play/estimate_errors.h"
#include "tools/play/estimate_link.h"
#include "tools/play/frame_tracker.h"

namespace puck {

/// Source of estimates.
enum class EstimateSource : std::uint8_t {
  kTruth,   ///< The true position with PUCK's errors.
  kEvents,  ///< PUCK, on the events of the simulated camera.
  kFrames,  ///< The true position as measured by a frame camera.
};

/// All parameters of a game, as in the services' configuration.
struct PlaySetup {
  SimulationParams world;
  TableCalibration table{Homography({1, 0, 0, 0, 1, 0, 0, 0, 1}), {}};
  PlayBridgeParams bridge;
  ArmControllerParams arm;
  HypothesesParams tracker;
  PuckSizeModel size_model;
  EstimateSource source = EstimateSource::kTruth;
  EstimateErrorParams errors;
  FrameTrackerParams frames;
  EstimateLinkParams link;
};

/// The services' defaults and a folder's calibrations: simulated_size.toml and
/// simulated_table.toml. Throws ConfigError if one is missing or invalid.
PlaySetup default_setup(const std::filesystem::path& calibration);

/// Sets the opponent's shots to between half of `max_speed_m_s` and `max_speed_m_s`. Throws
/// std::invalid_argument outside kMaxSpeedRange.
void set_shot_speed(GameParams& game, double max_speed_m_s);

}  // namespace puck
