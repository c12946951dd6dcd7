#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "common/events/timestamp.h"
#include "common/vision/geometry/truth_row.h"

namespace puck {

/// Whether at least half of the puck can be seen; below that it counts as hidden.
inline bool is_visible(const TruthRow& truth) { return truth.visible >= 0.5; }

/// The truth of a recording at any time, by linear interpolation between its rows.
class TruthTrack {
 public:
  /// Rows in the order of their times. Throws std::invalid_argument when there are none or their
  /// times do not increase.
  explicit TruthTrack(std::vector<TruthRow> rows);

  /// `std::nullopt` before the first and after the last row, and between rows more than
  /// `longest_gap_us` apart.
  std::optional<TruthRow> at(
      Timestamp time, std::int64_t longest_gap_us = std::numeric_limits<std::int64_t>::max()) const;

  const std::vector<TruthRow>& rows() const { return rows_; }

  Timestamp first() const { return rows_.front().time; }
  Timestamp last() const { return rows_.back().time; }

  /// Time at which the puck was first more than 5 px from its start; `std::nullopt` if never.
  std::optional<Timestamp> first_motion() const;

 private:
  std::vector<TruthRow> rows_;
};

}  // namespace puck
