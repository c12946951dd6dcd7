#pragma once

#include <filesystem>

#include "tools/simulate/sensor_bench.h"

namespace puck {

/// Takes all of sensor_checks.h's measurements of a sensor in its light, and some in other light,
/// and writes a PNG for each. Throws std::runtime_error when the folder cannot be written.
void write_sensor_plots(const SensorBench::Set& set, const std::filesystem::path& folder);

}  // namespace puck
