#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "common/calibration/flight_finder.h"
#include "common/simulation/simulation_params.h"
#include "common/simulation/table_game.h"

namespace puck {

/// A simulated game, measured every `period_us` with errors that last for 8 ms, as PUCK's do.
struct FlownGame {
  SimulationParams world;
  double seconds = 60;
  std::int64_t period_us = 2000;
  double noise_m = 0.0004;

  std::vector<TrackPoint> track() const {
    SimulationParams params = world;
    params.autonomous_robot = true;
    params.game.bank_share = 0.4;
    TableGame game(params);
    std::mt19937 random(static_cast<std::uint32_t>(params.seed));
    std::normal_distribution<double> normal;
    const double kept = std::exp(-static_cast<double>(period_us) / 8000);
    const double fresh_m = std::sqrt(1 - kept * kept) * noise_m;
    TablePoint error;
    std::vector<TrackPoint> points;
    for (std::int64_t us = PuckPhysics::kStep_us; us < static_cast<std::int64_t>(seconds * 1e6);
         us += PuckPhysics::kStep_us) {
      game.step();
      if (us % period_us != 0) continue;
      error.x_m = kept * error.x_m + fresh_m * normal(random);
      error.y_m = kept * error.y_m + fresh_m * normal(random);
      const auto& puck = game.puck();
      if (!puck) continue;
      points.push_back(
          {Timestamp{us}, {puck->position.x_m + error.x_m, puck->position.y_m + error.y_m}});
    }
    return points;
  }
};

}  // namespace puck
