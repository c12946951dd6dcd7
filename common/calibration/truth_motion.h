#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/events/timestamp.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/truth_row.h"

namespace puck {

/// The true motion of the puck where truth determines it: the whole puck is visible, with neither a
/// bounce nor a gap nearby.
class TruthMotion {
 public:
  struct State {
    Pixel position;
    PixelVelocity velocity;
  };

  /// Rows in the order of their times. Throws std::invalid_argument when there are none or their
  /// times do not increase.
  explicit TruthMotion(std::span<const TruthRow> rows);

  /// `std::nullopt` where truth does not determine the motion.
  std::optional<State> at(Timestamp time) const;

  Timestamp first() const { return rows_.front().time; }
  Timestamp last() const { return rows_.back().time; }
  /// Whether the whole puck is visible in any row.
  bool ever_visible() const;

 private:
  PixelVelocity velocity_between(std::size_t from, std::size_t to) const;
  bool is_steady(std::size_t row) const;

  std::vector<TruthRow> rows_;
  std::vector<Timestamp> uncertain_;  // Times around which the motion is uncertain.
};

}  // namespace puck
