#pragma once

#include <vector>

#include "common/evaluation/prediction_score.h"
#include "tools/play/play_setup.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// Errors of the bridge's TRAJECTORY in place and time of the shots' crossings, from the hit on.
PredictionReport score_predictions(const PlaySetup& setup, const std::vector<ShotFacts>& shots,
                                   int jobs);

/// Prints to stdout, for people.
void print(const PredictionReport& report);

}  // namespace puck
