#pragma once

#include <filesystem>
#include <vector>

#include "tools/play/shot.h"
#include "tools/play/shot_facts.h"
#include "tools/play/sweep.h"

namespace puck {

/// Writes saves_NAME.png into a folder, created if needed: the save rate of each curve with its 95
/// % interval, and its lower and upper bounds. Throws std::runtime_error on failure.
void write_plot(const Sweep& sweep, const std::filesystem::path& folder);

/// Writes shots.png there: each shot's crossing against its speed, by outcome. `outcomes` are in
/// the order of `shots`. Throws std::runtime_error on failure.
void write_plot(const std::vector<ShotFacts>& shots, const std::vector<ShotOutcome>& outcomes,
                const std::filesystem::path& folder);

}  // namespace puck
