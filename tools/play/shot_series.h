#pragma once

#include <cstdint>
#include <vector>

#include "tools/play/play_setup.h"
#include "tools/play/save_figures.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// The setup's game as one in which the puck is served and shot once: little time passes between
/// that the shot does not need.
PlaySetup for_single_shots(PlaySetup setup);

/// The first `count` games, counted from `seed`, whose first hit is a shot. They depend on the
/// setup's world and arm alone, so other trackers can be given the same shots. `jobs` threads; the
/// result does not depend on how many. Throws std::runtime_error when there are too few.
std::vector<ShotFacts> find_shots(const PlaySetup& setup, std::int64_t seed, int count, int jobs);

/// Plays each of them.
std::vector<ShotOutcome> play_shots(const PlaySetup& setup, const std::vector<ShotFacts>& shots,
                                    int jobs);

struct ShotSeries {
  std::vector<ShotOutcome> outcomes;  ///< Of shot i.
  SaveFigures figures;                ///< What they come to, and what it took.
};
ShotSeries play_series(const PlaySetup& setup, const std::vector<ShotFacts>& shots, int jobs);

/// The figures alone.
SaveFigures measure_saves(const PlaySetup& setup, const std::vector<ShotFacts>& shots, int jobs);

}  // namespace puck
