#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/compare/summary.h"

namespace puck {

/// The required value of one figure.
struct Goal {
  std::string title;  ///< With the unit.
  std::vector<std::string> sets;
  std::optional<double> Summary::*value = nullptr;
  bool at_least = false;                      ///< Otherwise at most.
  std::optional<double> by_correlation = {};  ///< Empty: reported only.
  std::optional<double> by_default = {};
};
std::vector<Goal> goals();

struct GoalCell {
  std::optional<double> measured;
  std::optional<double> bar;
  bool at_least = false;
  /// Empty without a bar; false when the figure could not be measured.
  std::optional<bool> reached() const;
};
struct GoalResult {
  std::string title;
  GoalCell reference;
  GoalCell correlation;
  GoalCell by_default;
};
std::vector<GoalResult> check_goals(const Comparison& comparison);

}  // namespace puck
