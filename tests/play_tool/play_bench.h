#pragma once

#include <cstdlib>
#include <filesystem>

#include "tests/support/sanitizers.h"
#include "tools/play/shot_series.h"

namespace puck {

inline constexpr int kShots = kIsSanitized ? 5 : 25;

/// Single shots as fast as the opponent can, on the project's own calibration.
inline PlaySetup fast_shots() {
  const std::filesystem::path source = std::getenv("PUCK_SOURCE_DIR");
  PlaySetup setup = for_single_shots(default_setup(source / "config/calibration"));
  set_shot_speed(setup.world.game, 15);
  return setup;
}

}  // namespace puck
