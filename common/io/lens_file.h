#pragma once

#include <filesystem>

#include "common/io/lens.h"

namespace puck {

/// Reads the table [lens]: model ("pinhole" or "fisheye"), width, height, fx, fy, cx, cy, and the
/// distortion: k1, k2, p1, p2, k3, or k1 to k4 of a fisheye. Throws ConfigError.
Lens read_lens_file(const std::filesystem::path& path);

}  // namespace puck
