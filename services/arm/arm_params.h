#pragma once

#include "common/control/arm_controller.h"
#include "common/io/config.h"
#include "services/arm/back_end.h"

namespace puck {

struct ArmServiceParams {
  ArmControllerParams controller;
  BackEndParams back_end;
  double loop_hz = 500;         ///< Key arm.loop_hz: rate of set-points.
  double state_hz = 500;        ///< Key arm.state_hz: rate of ARM_STATE.
  int real_time_priority = 20;  ///< Key arm.real_time_priority: of SCHED_FIFO; 0: none.
};

ArmServiceParams read_arm_params(Config& config);

}  // namespace puck
