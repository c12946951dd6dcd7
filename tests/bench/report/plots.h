#pragma once

#include <filesystem>

#include "tests/bench/report/benchmark_output.h"

namespace puck {

/// Charts as PNG: cost-against-rate.png (share of a core over events a second),
/// surface-against-k.png (events a second over the half width), step-against-size.png (a tracking
/// step over the kernel's size). A line has no points where nothing was measured. Throws
/// std::runtime_error when one cannot be written.
void write_plots(const BenchmarkOutput& output, const std::filesystem::path& folder);

}  // namespace puck
