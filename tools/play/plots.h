#pragma once

#include <filesystem>
#include <vector>

#include "common/evaluation/prediction_score.h"
#include "tools/play/shot.h"
#include "tools/play/shot_facts.h"
#include "tools/play/sweep.h"

namespace puck {

// Each writes a chart and its data into a folder, created if needed, and throws std::runtime_error
// on failure.

/// saves_NAME.png and .json: the save rate of each curve with its 95 % interval, and its lower and
/// upper bounds.
void write_plot(const Sweep& sweep, const std::filesystem::path& folder);

/// shots.png and .csv: each shot's crossing against its speed, by outcome. `outcomes` are in the
/// order of `shots`.
void write_plot(const std::vector<ShotFacts>& shots, const std::vector<ShotOutcome>& outcomes,
                const std::filesystem::path& folder);

/// prediction.png and .json: the error of the predicted place by the time to go.
void write_plot(const PredictionReport& report, const std::filesystem::path& folder);

}  // namespace puck
