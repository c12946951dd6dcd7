#pragma once

#include <cstdint>

#include "tools/play/play_setup.h"
#include "tools/play/save_figures.h"

namespace puck {

/// A game that goes on for so long. What a better arm would have saved is not known of it.
SaveFigures play_game(const PlaySetup& setup, std::int64_t seed, double seconds);

}  // namespace puck
