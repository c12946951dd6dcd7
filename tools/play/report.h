#pragma once

#include <filesystem>
#include <vector>

#include "tools/play/save_figures.h"
#include "tools/play/sweep.h"

namespace puck {

/// For a person, to stdout.
void print(const SaveFigures& figures);
/// Flat; what is not known is null. Throws std::runtime_error when it cannot be written.
void write_json(const SaveFigures& figures, const std::filesystem::path& path);

void print(const Sweep& sweep);
/// An array `points` of the above, each with its `value` and `curve`.
void write_json(const Sweep& sweep, const std::filesystem::path& path);

}  // namespace puck
