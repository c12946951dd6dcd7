#pragma once

#include <cstdint>
#include <vector>

#include "tools/play/play_setup.h"
#include "tools/play/save_figures.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// The setup's game with one serve and one shot, and little time in between.
PlaySetup for_single_shots(PlaySetup setup);

/// The first `count` games, with seeds from `seed` on, whose first hit is a shot. They depend on
/// the setup's world and arm only, so they fit other trackers, too. `jobs` threads; the result does
/// not depend on their number. Throws std::runtime_error if there are too few.
std::vector<ShotFacts> find_shots(const PlaySetup& setup, std::int64_t seed, int count, int jobs);

/// Plays each of them.
std::vector<ShotOutcome> play_shots(const PlaySetup& setup, const std::vector<ShotFacts>& shots,
                                    int jobs);

struct ShotSeries {
  std::vector<ShotOutcome> outcomes;  ///< Of shot i.
  SaveFigures figures;                ///< Sums over the shots, and the cost.
};
ShotSeries play_series(const PlaySetup& setup, const std::vector<ShotFacts>& shots, int jobs);

/// The figures only.
SaveFigures measure_saves(const PlaySetup& setup, const std::vector<ShotFacts>& shots, int jobs);

}  // namespace puck
