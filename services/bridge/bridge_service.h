#pragma once

#include <cstdint>
#include <stop_token>
#include <string>

#include "common/io/config.h"
#include "common/io/table_file.h"
#include "common/play/play_bridge.h"
#include "common/runtime/latency_histogram.h"
#include "services/launch/service.h"

namespace puck {

struct BridgeServiceParams {
  TableCalibration table;  ///< File of bridge.table.
  PlayBridgeParams play;
  int real_time_priority = 15;  ///< Key bridge.real_time_priority: of SCHED_FIFO; 0: none.
};

/// puck-bridge: receives ESTIMATE, ARM_STATE and HEAD; publishes TRAJECTORY, ARM_COMMAND and GAME.
class BridgeService : public Service {
 public:
  static BridgeServiceParams read_params(Config& config);

  /// Throws std::invalid_argument that names the key when a value is out of its range.
  BridgeService(const BridgeServiceParams& params, ServiceContext& context);

  void run(std::stop_token stop) override;
  void report(StatusReport& report) const override;

 private:
  struct Standing {
    ServiceState state = ServiceState::kWaiting;
    std::string text;
  };

  /// Handles waiting messages; without any, waits for the next one for a limited time.
  void handle_messages();
  /// Returns whether a command was sent.
  bool command();
  void publish_what_is_due();
  Standing standing() const;
  void follow_state();
  void warn_of_estimates();

  ServiceContext& context_;
  PlayBridge bridge_;
  int real_time_priority_;
  std::int64_t idle_us_ = 0;           // CLOCK_MONOTONIC: end of the last wait
  std::int64_t last_estimate_us_ = 0;  // CLOCK_MONOTONIC; 0: none yet
  std::string text_;                   // text of the state
  std::int64_t text_since_us_ = 0;     // CLOCK_MONOTONIC
  std::string logged_text_;
  std::int64_t warned_of_ = 0;
  LatencyHistogram estimate_to_command_;
  LatencyHistogram estimate_wait_;  // from the kernel's receipt to the handler
};

}  // namespace puck
