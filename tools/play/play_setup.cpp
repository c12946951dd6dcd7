#include "tools/play/play_setup.h"

#include "common/io/contour_calibration_file.h"
#include "common/io/size_model_file.h"
#include "common/vision/presets.h"
#include "tools/play/option_ranges.h"

namespace puck {

PlaySetup default_setup(const std::filesystem::path& calibration) {
  const std::filesystem::path size_file = calibration / "simulated_size.toml";
  PlaySetup setup;
  setup.table = read_table_file(calibration / "simulated_table.toml");
  if (setup.table.motion) {
    setup.bridge.motion = with_constants(setup.bridge.motion, *setup.table.motion);
  }
  setup.arm.track.camera_is_real = false;
  setup.tracker = default_params();
  setup.tracker.contour = read_contour_calibration(size_file).value_or(ContourCalibration{});
  setup.size_model = read_size_model_file(size_file);
  return setup;
}

void set_shot_speed(GameParams& game, double max_speed_m_s) {
  kMaxSpeedRange.require(max_speed_m_s);
  game.shot_speed_max_m_s = max_speed_m_s;
  game.shot_speed_min_m_s = max_speed_m_s / 2;
}

}  // namespace puck
