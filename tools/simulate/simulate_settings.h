#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/simulation/simulation_params.h"

namespace puck {

/// From one row of truth to the next.
inline constexpr std::int64_t kTruthPeriod_us = 1000;

/// What the command line asks for.
struct SimulateSettings {
  std::string output;                   ///< BASE of the files that are written.
  std::filesystem::path sensor_checks;  ///< Folder for the plots; empty: none.
  std::filesystem::path scene;
  std::optional<std::int64_t> seed;
  double seconds = 10;
  bool moving = false;
  std::string format = "evt3";
  std::string command;  ///< As typed; goes into the files.
};

/// The scene file, overridden by the command line. The world plays its own robot, since no arm is
/// there. Throws ConfigError or std::invalid_argument with one line.
SimulationParams simulation_params_of(const SimulateSettings& settings);

}  // namespace puck
