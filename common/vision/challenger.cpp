#include "common/vision/challenger.h"

#include <algorithm>
#include <cmath>

namespace puck {

bool Challenger::leads() const {
  constexpr double kSigma = 3;
  constexpr double kLeast = 3;
  constexpr double kOwnShare = 0.3;
  return lead_ > kSigma * std::sqrt(lead_variance_) + kLeast &&
         total_ > kOwnShare * total_variance_;
}

void Challenger::note_found(const Found& again) {
  if (again.is_conjecture == found_.is_conjecture) {
    found_.score = std::max(found_.score, again.score);
  } else if (found_.is_conjecture) {
    found_ = again;
  }
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
