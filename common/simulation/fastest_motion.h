#pragma once

#include "common/simulation/camera_view.h"
#include "common/simulation/simulation_params.h"
#include "common/simulation/table_game.h"

namespace puck {

/// An upper bound for the speed in the image of anything that moves in the game within `ahead_s`
/// from now, a puck that a mallet may hit included.
double fastest_px_s(const TableGame& game, const SimulationParams& params, const CameraView& view,
                    double ahead_s);

}  // namespace puck
