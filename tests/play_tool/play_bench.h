#pragma once

#include <cstdint>

#include "common/events/sensor_size.h"
#include "tests/support/environment.h"
#include "tests/support/sanitizers.h"
#include "tools/play/shot_series.h"

namespace puck {

inline constexpr SensorSize kSensor{640, 480};
/// Time between two rows of truth.
inline constexpr std::int64_t kStepUs = 200;
inline constexpr int kShots = kIsSanitized ? 5 : 25;

/// Single shots at the opponent's highest speed, on the project's own calibration.
inline PlaySetup fast_shots() {
  PlaySetup setup = for_single_shots(default_setup(source_folder() / "config/calibration"));
  set_shot_speed(setup.world.game, 15);
  return setup;
}

}  // namespace puck
