#pragma once

#include <filesystem>
#include <vector>

#include "tools/play/save_figures.h"
#include "tools/play/sweep.h"

namespace puck {

/// Prints to stdout, for people.
void print(const SaveFigures& figures);
/// Writes a flat object with null for unknown values. Throws std::runtime_error on failure.
void write_json(const SaveFigures& figures, const std::filesystem::path& path);

void print(const Sweep& sweep);
/// Writes an array `points` of such objects, each with its `value` and `curve`.
void write_json(const Sweep& sweep, const std::filesystem::path& path);

}  // namespace puck
