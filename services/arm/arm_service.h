#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

#include "common/control/arm_controller.h"
#include "common/io/config.h"
#include "common/runtime/latency_histogram.h"
#include "services/arm/arm_params.h"
#include "services/launch/service.h"

namespace puck {

/// puck-arm: receives ARM_COMMAND and ESTIMATE, steps the arm's loop on the monotonic clock,
/// publishes ARM_STATE.
class ArmService : public Service {
 public:
  static ArmServiceParams read_params(Config& config) { return read_arm_params(config); }

  /// Throws std::invalid_argument that names the key when a value is out of its range.
  ArmService(const ArmServiceParams& params, ServiceContext& context);

  void run(std::stop_token stop) override;
  void report(StatusReport& report) const override;

 private:
  /// Waits for the next step and takes it.
  void turn();
  void brake();
  void wait_until_due();
  /// Handles waiting messages until `end_us`, CLOCK_MONOTONIC; returns whether none is left.
  bool drain_until(std::int64_t end_us);
  void step(const HostNow& now);
  void publish_state(const HostNow& now);
  void follow_state(const ArmState& state);
  void warn_of_refusals();

  ServiceContext& context_;
  ArmController controller_;
  int real_time_priority_;
  std::int64_t step_period_us_;
  std::int64_t state_period_us_;
  // CLOCK_MONOTONIC.
  std::int64_t due_us_ = 0;
  std::int64_t stepped_us_ = 0;
  std::int64_t next_state_us_ = 0;
  bool is_drained_ = true;
  LatencyHistogram loop_jitter_;  // delay of steps
  std::int64_t pauses_ = 0;
  std::int64_t time_skipped_us_ = 0;
  std::int64_t refused_before_ = 0;
  std::optional<ArmActivity> logged_activity_;
  std::string logged_reason_;
  std::int64_t told_us_ = 0;
};

}  // namespace puck
