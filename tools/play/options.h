#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

namespace puck {

/// Options of the command line.
struct PlayOptions {
  double seconds = 0;        ///< Length of a whole game; 0: not given.
  int shots = 0;             ///< 0: not given.
  double max_speed_m_s = 0;  ///< 0: not given.
  std::string source = "truth";
  std::string sweep;
  std::filesystem::path log;
  std::filesystem::path calibration = "config/calibration";
  bool predictions = false;
  bool fits_errors = false;
  std::filesystem::path json;
  std::filesystem::path plots;
  std::int64_t seed = 1;
  bool moving = false;
  int jobs = 0;  ///< 0: one a core.
  double latency_ms = 1;
  double rate_hz = 1000;
  double loss_percent = 0;
  double burst_ms = 0;
  double frames_hz = 0;  ///< 0: PUCK instead of a frame camera.
};

/// `options` must outlive the parsing.
void add_options(CLI::App& app, PlayOptions& options);

}  // namespace puck
