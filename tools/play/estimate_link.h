#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/messaging/channels.h"
#include "common/simulation/random.h"

namespace puck {

struct EstimateLinkParams {
  double rate_hz = 1000;            ///< Estimates a second.
  std::int64_t latency_us = 1'000;  ///< From the sensor to the bridge and the arm.
  double loss_percent = 0;          ///< Of the estimates.
  /// Losses come one by one, or with this in bursts that take so long on average.
  std::int64_t burst_us = 0;
};

/// The way of the estimates from the tracker to whoever uses them: a rate, a delay, and losses.
/// One thread.
class EstimateLink {
 public:
  /// Throws std::invalid_argument that names the option when a value is out of its range.
  EstimateLink(const EstimateLinkParams& params, std::int64_t seed);

  /// Whether an estimate is to be made at `now_us`; once a period.
  bool is_due(std::int64_t now_us);
  /// Sends one, which arrives `extra_us` later than others would.
  void send(const puck_estimate_t& estimate, std::int64_t now_us, std::int64_t extra_us = 0);
  /// The next that has arrived by `now_us`.
  std::optional<puck_estimate_t> receive(std::int64_t now_us);

 private:
  struct Sent {
    std::int64_t arrives_us = 0;
    puck_estimate_t estimate;
  };

  bool is_lost(std::int64_t now_us);

  EstimateLinkParams params_;
  Random random_;
  double next_due_us_ = 0;
  bool in_burst_ = false;
  std::int64_t burst_judged_us_ = 0;
  std::deque<Sent> under_way_;
};

}  // namespace puck
