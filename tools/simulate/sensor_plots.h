#pragma once

#include <filesystem>

#include "tools/simulate/sensor_bench.h"

namespace puck {

/// Makes all measurements of sensor_checks.h on a sensor, some under further light levels; writes
/// curves.csv with all of them (chart,curve,x,y) and a PNG for each chart. Throws
/// std::runtime_error if a file cannot be written.
void write_sensor_plots(const SensorBench::Set& set, const std::filesystem::path& folder);

}  // namespace puck
