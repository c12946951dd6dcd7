#pragma once

#include <cstdint>

#include "common/simulation/simulated_truth.h"
#include "tools/simulate/simulate_settings.h"

namespace puck {

struct RecordingSummary {
  std::int64_t events = 0;
  std::int64_t lost = 0;  ///< Events lost at the sensor's readout.
  double seconds = 0;     ///< Sensor time.
  double took_s = 0;      ///< Wall time.
  int marks = 0;          ///< Rows of BASE.annotations.csv.
  bool has_size_model = false;
  GameCounts counts;
};

/// Plays the game and writes BASE.raw (or the format's ending), BASE.truth.csv,
/// BASE.annotations.csv and BASE.toml; prints progress to stderr. Throws with a one-line message if
/// a file cannot be written.
RecordingSummary record(const SimulateSettings& settings, const SimulationParams& params);

}  // namespace puck
