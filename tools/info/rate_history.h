#pragma once

#include <cstdint>
#include <vector>

#include "common/events/timestamp.h"

namespace puck {

/// Counts of events over a time of unknown length, in bins of equal time: when they do not suffice,
/// each two become one.
class RateHistory {
 public:
  static constexpr std::size_t kMostBins = 4096;

  /// Times in order.
  void add(Timestamp time) {
    if (bins_.empty()) first_ = time;
    std::uint64_t bin = static_cast<std::uint64_t>(time - first_) / bin_us_;
    while (bin >= kMostBins) {
      halve();
      bin /= 2;
    }
    if (bin >= bins_.size()) bins_.resize(bin + 1);
    ++bins_[bin];
  }

  const std::vector<std::int64_t>& bins() const { return bins_; }
  std::int64_t bin_us() const { return static_cast<std::int64_t>(bin_us_); }

  /// The same in at most `most` bins; `bin_us` becomes their length.
  std::vector<std::int64_t> coarse(std::size_t most, std::int64_t& bin_us) const;

 private:
  void halve();

  Timestamp first_;
  std::uint64_t bin_us_ = 10;
  std::vector<std::int64_t> bins_;
};

}  // namespace puck
