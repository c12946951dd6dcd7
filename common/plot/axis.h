#pragma once

#include <string>
#include <vector>

namespace puck {

/// An axis of a chart: what it shows, and where a value lies on it.
struct Axis {
  std::string label;
  double from = 0;
  double to = 1;  ///< Less than `from`: the axis runs backwards, as rows of an image do.
  bool logarithmic = false;
  /// Instead of numbers: this many things side by side, each a word or two lines. Thing i lies at
  /// i + 0.5; `from` and `to` do not count.
  std::vector<std::string> things;

  struct Tick {
    double value = 0;
    std::string label;  ///< Empty: a line only.
  };
  /// Where to draw lines of the grid; numbers are round.
  std::vector<Tick> ticks() const;

  /// 0 at `from`, 1 at `to`. On a logarithmic axis what is not positive lies far below.
  double fraction(double value) const;
};

/// From 0 to 5 % beyond the largest value; to 1 where nothing is larger than 0.
Axis axis_from_zero(std::string label, double largest);
/// Whole decades around the positive ones of both values.
Axis logarithmic_axis(std::string label, double smallest, double largest);

}  // namespace puck
