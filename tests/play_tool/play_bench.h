#pragma once

#include <cstdlib>
#include <filesystem>

#include "tools/play/shot_series.h"

namespace puck {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int kShots = 5;
#else
inline constexpr int kShots = 25;
#endif

/// Single shots as fast as the opponent can, on the project's own calibration.
inline PlaySetup fast_shots() {
  const std::filesystem::path source = std::getenv("PUCK_SOURCE_DIR");
  PlaySetup setup = for_single_shots(default_setup(source / "config/calibration"));
  set_shot_speed(setup.world.game, 15);
  return setup;
}

}  // namespace puck
