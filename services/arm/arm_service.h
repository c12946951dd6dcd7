#pragma once

#include <cstdint>
#include <stop_token>

#include "common/control/arm_controller.h"
#include "common/io/config.h"
#include "services/launch/service.h"

namespace puck {

struct ArmServiceParams {
  ArmControllerParams controller;
  double state_hz = 500;  ///< Key arm.state_hz: ARM_STATE is published so many times a second.
};

/// puck-arm: hears ARM_COMMAND and ESTIMATE, steps the simulated arm a thousand times a second on
/// the monotonic clock, publishes ARM_STATE.
class ArmService : public Service {
 public:
  static ArmServiceParams read_params(Config& config);

  /// Throws std::invalid_argument that names the key when a value is out of its range.
  ArmService(const ArmServiceParams& params, ServiceContext& context);

  void run(std::stop_token stop) override;
  void report(StatusReport& report) const override;

 private:
  void step_until(const HostNow& now);
  void publish_state(const HostNow& now);
  void follow_state(const arm_state_t& state);
  void warn_of_refusals();

  ServiceContext& context_;
  ArmController controller_;
  std::int64_t state_period_us_;
  std::int64_t next_step_us_ = 0;   // CLOCK_MONOTONIC
  std::int64_t next_state_us_ = 0;  // CLOCK_MONOTONIC
  std::int64_t time_skipped_us_ = 0;
  std::int64_t refused_before_ = 0;
  int logged_state_ = -1;
};

}  // namespace puck
