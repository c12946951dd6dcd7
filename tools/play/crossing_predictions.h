#pragma once

#include <filesystem>
#include <vector>

#include "common/evaluation/prediction_score.h"
#include "tools/play/play_setup.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// How well the bridge's TRAJECTORY foretells where and when the shots cross, from the hit on.
PredictionReport score_predictions(const PlaySetup& setup, const std::vector<ShotFacts>& shots,
                                   int jobs);

/// For a person, to stdout.
void print(const PredictionReport& report);
/// Writes prediction.png into a folder, which is made if need be. Throws std::runtime_error when
/// that fails.
void write_plot(const PredictionReport& report, const std::filesystem::path& folder);

}  // namespace puck
