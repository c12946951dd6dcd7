#include "tools/simulate/simulate_settings.h"

#include <cstdint>
#include <stdexcept>
#include <string>

#include "common/io/config.h"
#include "common/simulation/visit_parameters.h"

namespace puck {
namespace {

void check_keys_together(const SimulationParams& params) {
  check(params);
  if (kTruthPeriod_us % params.slice_us != 0) {
    throw std::invalid_argument("world.slice_us must divide 1000, for a truth every 1 ms, got " +
                                std::to_string(params.slice_us));
  }
}

}  // namespace

SimulationParams simulation_params_of(const SimulateSettings& settings) {
  SimulationParams params;
  if (!settings.scene.empty()) {
    Config scene = Config::from_file(settings.scene);
    visit_parameters(scene, params);
    scene.reject_unknown();
  }
  if (settings.seed) params.seed = *settings.seed;
  if (settings.moving) params.moving_camera = true;
  params.autonomous_robot = true;
  try {
    check_keys_together(params);
  } catch (const std::invalid_argument& error) {
    // The keys do not know the name of their file.
    throw std::invalid_argument(settings.scene.string() + ": " + error.what());
  }
  return params;
}

}  // namespace puck
