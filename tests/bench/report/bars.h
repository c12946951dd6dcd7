#pragma once

#include <optional>
#include <string>
#include <vector>

namespace puck {

/// A figure with a goal, or one that is always reported.
struct Bar {
  enum class Kind {
    kReport,  ///< No goal.
    kAtLeast,
    kAtMost,
  };

  std::string key;   ///< In the JSON; ends in its unit.
  std::string what;  ///< For a person.
  Kind kind = Kind::kReport;
  double limit = 0;
  std::optional<double> reach;  ///< Value of a prototype.

  bool is_met_by(double value) const;
  /// `>= 20 (33 seen)`; empty without a goal.
  std::string text() const;
};

/// In the order of the table. A run is complete when all of them were measured.
const std::vector<Bar>& bars();

}  // namespace puck
