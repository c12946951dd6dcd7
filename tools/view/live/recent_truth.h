#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/evaluation/truth_track.h"
#include "common/events/timestamp.h"

namespace puck {

/// The truth of the last half second at any time. One thread.
class RecentTruth {
 public:
  /// Starts again when the time goes back.
  void add(const TruthRow& row);

  /// Interpolated; up to 20 ms after the newest row, that row. Nothing further away.
  std::optional<TruthRow> at(Timestamp time) const;

 private:
  std::deque<TruthRow> rows_;
};

}  // namespace puck
