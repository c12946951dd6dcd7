#pragma once

#include <filesystem>
#include <vector>

#include "tools/play/shot.h"
#include "tools/play/shot_facts.h"
#include "tools/play/sweep.h"

namespace puck {

/// Writes saves_NAME.png into a folder, which is made if need be: the save rate of each curve with
/// its 95 % interval, and between what they must lie. Throws std::runtime_error when that fails.
void write_plot(const Sweep& sweep, const std::filesystem::path& folder);

/// Writes shots.png there: where each shot crosses against its speed, and what became of it;
/// `outcomes` are those of `shots`, one by one. Throws std::runtime_error when that fails.
void write_plot(const std::vector<ShotFacts>& shots, const std::vector<ShotOutcome>& outcomes,
                const std::filesystem::path& folder);

}  // namespace puck
