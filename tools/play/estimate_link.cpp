#include "tools/play/estimate_link.h"

#include <cmath>

#include "tools/play/option_ranges.h"

namespace puck {
namespace {

constexpr std::uint64_t kLossStream = 41;

}  // namespace

EstimateLink::EstimateLink(const EstimateLinkParams& params, std::int64_t seed)
    : params_(params), random_(seed, kLossStream) {
  kRateRange.require(params_.rate_hz);
  kLatencyRange.require(static_cast<double>(params_.latency_us) / 1e3);
  kLossRange.require(params_.loss_percent);
  kBurstRange.require(static_cast<double>(params_.burst_us) / 1e3);
  in_burst_ = random_.uniform() * 100 < params_.loss_percent;
}

bool EstimateLink::is_due(std::int64_t now_us) {
  if (static_cast<double>(now_us) < next_due_us_) return false;
  next_due_us_ += 1e6 / params_.rate_hz;
  return true;
}

// Bursts begin and end at any time: the share of losses does not depend on the rate.
bool EstimateLink::is_lost(std::int64_t now_us) {
  const double share = params_.loss_percent / 100;
  if (params_.burst_us == 0 || share == 0 || share == 1) return random_.uniform() < share;
  const double passed = static_cast<double>(now_us - burst_judged_us_);
  burst_judged_us_ = now_us;
  const double leave_per_us = 1 / static_cast<double>(params_.burst_us);
  const double enter_per_us = leave_per_us * share / (1 - share);
  // A Markov chain of two states in continuous time.
  const double memory = std::exp(-(leave_per_us + enter_per_us) * passed);
  const double in_burst = in_burst_ ? share + (1 - share) * memory : share * (1 - memory);
  in_burst_ = random_.uniform() < in_burst;
  return in_burst_;
}

void EstimateLink::send(const PublishedEstimate& estimate, std::int64_t now_us,
                        std::int64_t extra_us) {
  if (is_lost(now_us)) return;
  under_way_.push_back({now_us + params_.latency_us + extra_us, estimate});
}

std::optional<PublishedEstimate> EstimateLink::receive(std::int64_t now_us) {
  if (under_way_.empty() || under_way_.front().arrives_us > now_us) return std::nullopt;
  const PublishedEstimate estimate = under_way_.front().estimate;
  under_way_.pop_front();
  return estimate;
}

}  // namespace puck
