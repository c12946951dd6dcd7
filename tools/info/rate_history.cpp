#include "tools/info/rate_history.h"

namespace puck {

std::vector<std::int64_t> RateHistory::coarse(std::size_t most, std::int64_t& bin_us) const {
  const std::size_t joined = (bins_.size() + most - 1) / most;
  bin_us = static_cast<std::int64_t>(bin_us_ * joined);
  std::vector<std::int64_t> rows(joined == 0 ? 0 : (bins_.size() + joined - 1) / joined);
  for (std::size_t i = 0; i < bins_.size(); ++i) rows[i / joined] += bins_[i];
  return rows;
}

void RateHistory::halve() {
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const std::int64_t count = bins_[i];
    bins_[i] = 0;
    bins_[i / 2] += count;
  }
  bins_.resize((bins_.size() + 1) / 2);
  bin_us_ *= 2;
}

}  // namespace puck
