#pragma once

#include "common/simulation/camera_view.h"
#include "common/simulation/simulation_params.h"
#include "common/simulation/table_game.h"

namespace puck {

/// An upper bound, in px/s, for the image speed of all moving objects within `ahead_s` from now,
/// including a puck that a mallet may hit.
double fastest_px_s(const TableGame& game, const SimulationParams& params, const CameraView& view,
                    double ahead_s);

}  // namespace puck
