#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/events/timestamp.h"
#include "common/vision/pixel.h"
#include "common/vision/truth_row.h"

namespace puck {

/// The true motion of the puck wherever truth tells it well: all of it to be seen, and neither a
/// bounce nor a gap just before.
class TruthMotion {
 public:
  struct State {
    Pixel position;
    PixelVelocity velocity;
  };

  /// Rows in the order of their times. Throws std::invalid_argument when there are none or their
  /// times do not grow.
  explicit TruthMotion(std::span<const TruthRow> rows);

  /// Nothing where truth does not tell the motion well. Times mostly grow from call to call.
  std::optional<State> at(Timestamp time) const;

  Timestamp first() const { return rows_.front().time; }
  Timestamp last() const { return rows_.back().time; }
  /// Whether all of the puck can be seen at all.
  bool ever_visible() const;

 private:
  PixelVelocity velocity_between(std::size_t from, std::size_t to) const;
  bool is_steady(std::size_t row) const;

  std::vector<TruthRow> rows_;
  std::vector<Timestamp> upsets_;  // Times around which the motion is not known well.
};

}  // namespace puck
