#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/simulation/simulation_params.h"

namespace puck {

/// Between two rows of truth.
inline constexpr std::int64_t kTruthPeriod_us = 1000;

/// Options of the command line.
struct SimulateSettings {
  std::string output;                   ///< BASE of the output files.
  std::filesystem::path sensor_checks;  ///< Folder for the plots; empty: none.
  std::filesystem::path scene;
  std::optional<std::int64_t> seed;
  double seconds = 10;
  bool moving = false;
  std::string format = "evt3";
  std::string command;  ///< The command line; quoted in the files.
};

/// The scene file, overridden by the command line. The world plays its own robot, as there is no
/// arm. Throws ConfigError or std::invalid_argument with a one-line message.
SimulationParams simulation_params_of(const SimulateSettings& settings);

}  // namespace puck
