#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/messages/published_estimate.h"
#include "common/simulation/random.h"

namespace puck {

struct EstimateLinkParams {
  double rate_hz = 1000;            ///< Estimates a second.
  std::int64_t latency_us = 1'000;  ///< From the sensor to the bridge and the arm.
  double loss_percent = 0;          ///< Share of lost estimates.
  /// 0: single losses; else the mean length of bursts.
  std::int64_t burst_us = 0;
};

/// The path of estimates from the tracker to their users: a rate, a delay, and losses.
/// One thread.
class EstimateLink {
 public:
  /// Throws std::invalid_argument that names the option of a value out of range.
  EstimateLink(const EstimateLinkParams& params, std::int64_t seed);

  /// Whether to make an estimate at `now_us`; once per period.
  bool is_due(std::int64_t now_us);
  /// Sends an estimate, with `extra_us` more delay than usual.
  void send(const PublishedEstimate& estimate, std::int64_t now_us, std::int64_t extra_us = 0);
  /// The next estimate that has arrived by `now_us`.
  std::optional<PublishedEstimate> receive(std::int64_t now_us);

 private:
  struct Sent {
    std::int64_t arrives_us = 0;
    PublishedEstimate estimate;
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
