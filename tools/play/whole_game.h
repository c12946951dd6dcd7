#pragma once

#include <cstdint>

#include "tools/play/play_setup.h"
#include "tools/play/save_figures.h"

namespace puck {

/// Plays a game of this length. The saves of a better arm are unknown for it.
SaveFigures play_game(const PlaySetup& setup, std::int64_t seed, double seconds);

}  // namespace puck
