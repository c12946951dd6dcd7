#include "common/vision/challenger.h"

#include <algorithm>
#include <cmath>

#include "common/vision/decision_time.h"

namespace puck {

bool Challenger::leads() const {
  constexpr double kSigma = 3;
  constexpr double kLeast = 3;
  constexpr double kOwnShare = 0.3;
  return lead_ > kSigma * std::sqrt(lead_variance_) + kLeast &&
         total_ > kOwnShare * total_variance_;
}

void Challenger::catch_up(std::span<const MissedEvents::Missed> missed, std::int64_t period_us,
                          std::int64_t decided_us, const ContourContext& context) {
  std::int64_t last_us = born_us_;
  const auto decide_before = [&](std::int64_t time_us) {
    const std::int64_t due_us = decision_before(time_us, period_us);
    if (due_us <= last_us) return;
    decide(due_us, context);
    last_us = due_us;
  };
  for (const MissedEvents::Missed& one : missed) {
    if (one.event.time_us <= born_us_ || is_blind_to(one.event)) continue;
    decide_before(one.event.time_us);
    take(one.event, one.main_worth, context);
  }
  decide_before(decided_us + 1);
  tried_since_us_ = std::max(born_us_, decided_us);
}

void Challenger::note_found(const Found& again) {
  if (again.is_conjecture == found_.is_conjecture) {
    found_.score = std::max(found_.score, again.score);
  } else if (found_.is_conjecture) {
    found_ = again;
  }
  found_.trail = again.trail;
}

std::int64_t Challenger::convincing_for_us(bool convinces, std::int64_t time_us) {
  if (!convinces) {
    convincing_since_us_ = -1;
    return 0;
  }
  if (convincing_since_us_ < 0) convincing_since_us_ = time_us;
  return time_us - convincing_since_us_;
}

}  // namespace puck
