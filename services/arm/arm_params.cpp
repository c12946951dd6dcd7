#include "services/arm/arm_params.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/io/joint_table_file.h"
#include "common/io/table_file.h"
#include "services/arm/yarp_settings.h"

namespace puck {
namespace {

void read_safety(Config& config, ArmControllerParams& controller) {
  std::int64_t dead_man_ms = controller.guard.dead_man_us / 1000;
  config.read("arm.dead_man_ms", dead_man_ms, 1, 100);
  controller.guard.dead_man_us = controller.track.dead_man_us = dead_man_ms * 1000;
  std::int64_t clock_error_ms = controller.guard.max_clock_error_us / 1000;
  config.read("arm.max_clock_error_ms", clock_error_ms, 1, 200);
  controller.guard.max_clock_error_us = clock_error_ms * 1000;
  controller.track.max_clock_error_us = clock_error_ms * 1000;
  config.read("arm.max_tracking_error_deg", controller.arm.max_tracking_error_deg, 0.01, 90);
  std::int64_t encoder_age_ms = controller.arm.max_encoder_age_us / 1000;
  config.read("arm.max_encoder_age_ms", encoder_age_ms, 1, 1000);
  controller.arm.max_encoder_age_us = encoder_age_ms * 1000;
}

// Returns whether a joint table was given.
bool read_motion(Config& config, ArmMotionParams& motion) {
  config.read("arm.max_speed_m_s", motion.max_speed_m_s, 0.001, 20);
  config.read("arm.max_acceleration_m_s2", motion.max_acceleration_m_s2, 0.01, 1000);
  config.read("arm.max_jerk_m_s3", motion.max_jerk_m_s3, 1, 100'000);
  config.read("arm.approach_deg_s", motion.approach_deg_s, 0.1, 60);
  std::string joint_table;
  config.read("arm.joint_table", joint_table);
  if (joint_table.empty()) return false;
  motion.joints = read_joint_table_file(joint_table);
  return true;
}

void read_back_end(Config& config, ArmServiceParams& params) {
  constexpr std::array<std::string_view, 2> kBackEnds{"simulated", "yarp"};
  config.read_choice("arm.back_end", params.back_end.name, kBackEnds);
  config.read("arm.allow_unauthenticated", params.back_end.allow_unauthenticated);
  params.back_end.yarp = read_yarp_params(config);
  SimulatedBackEndParams& simulated = params.controller.simulated;
  config.read("arm.simulated_frequency_hz", simulated.frequency_hz, 0.1, 1000);
  config.read("arm.simulated_delay_ms", simulated.delay_ms, 0, 100);
  config.read("arm.simulated_backlash_deg", simulated.backlash_deg, 0, 10);
}

}  // namespace

ArmServiceParams read_arm_params(Config& config) {
  ArmServiceParams params;
  ArmControllerParams& controller = params.controller;
  constexpr std::array<std::string_view, 2> kModes{"commanded", "follow"};
  std::string mode(kModes[0]);
  std::string table_file;
  config.read_choice("arm.mode", mode, kModes);
  config.read("arm.table", table_file);
  config.read("arm.margin_m", controller.margin_m, 0, 1);
  config.read("arm.loop_hz", params.loop_hz, 100, 1000);
  config.read("arm.state_hz", params.state_hz, 10, 1000);
  config.read("arm.real_time_priority", params.real_time_priority, 0, 49);
  config.read("arm.line_x_m", controller.line_x_m, 0, 10);
  config.read("arm.line_half_m", controller.guard.line_half_m, 0.001, 10);
  config.read("arm.excess_m", controller.guard.excess_m, 0, 0.1);
  read_back_end(config, params);
  read_safety(config, controller);
  const bool has_joint_table = read_motion(config, controller.arm);

  if (params.back_end.name == "yarp" && !has_joint_table) {
    config.fail(
        "arm.joint_table",
        "is needed when arm.back_end is \"yarp\": the built-in table is the simulated arm's");
  }
  // A real arm moves only by a camera whose clock can be checked.
  controller.track.camera_is_real = params.back_end.name == "yarp";
  if (mode == "follow") {
    if (table_file.empty()) config.fail("arm.table", "is needed when arm.mode is \"follow\"");
    controller.mode = ArmMode::kFollow;
    const TableCalibration table = read_table_file(table_file);
    controller.view = ArmView{table.table_from_image, table.geometry};
  }
  return params;
}

}  // namespace puck
