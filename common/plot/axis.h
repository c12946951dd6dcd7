#pragma once

#include <string>
#include <vector>

namespace puck {

/// An axis of a chart: its label and its scale.
struct Axis {
  std::string label;
  double from = 0;
  double to = 1;  ///< If less than `from`, the axis is reversed, as for rows of an image.
  bool logarithmic = false;
  /// Categories instead of numbers, side by side, each a word or two lines. Category i lies at i +
  /// 0.5; `from` and `to` are ignored.
  std::vector<std::string> things;

  struct Tick {
    double value = 0;
    std::string label;  ///< Empty: a grid line only.
  };
  /// Grid lines, at round numbers.
  std::vector<Tick> ticks() const;

  /// 0 at `from`, 1 at `to`. On a logarithmic axis, values that are not positive lie far below.
  double fraction(double value) const;
};

/// From 0 to 5 % beyond the largest value; to 1 if no value is above 0.
Axis axis_from_zero(std::string label, double largest);
/// The whole decades around the positive ones of both values.
Axis logarithmic_axis(std::string label, double smallest, double largest);

}  // namespace puck
