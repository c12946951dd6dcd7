#pragma once

#include <filesystem>

#include "tools/simulate/sensor_bench.h"

namespace puck {

/// Makes all measurements of sensor_checks.h on a sensor, some under further light levels, and
/// writes a PNG for each. Throws std::runtime_error if the folder cannot be written.
void write_sensor_plots(const SensorBench::Set& set, const std::filesystem::path& folder);

}  // namespace puck
