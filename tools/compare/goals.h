#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/compare/summary.h"

namespace puck {

/// A figure that a preset is to reach.
struct Goal {
  std::string title;  ///< With the unit.
  std::vector<std::string> sets;
  std::optional<double> Summary::*value = nullptr;
  bool at_least = false;                      ///< Otherwise at most.
  std::optional<double> by_correlation = {};  ///< Nothing: only reported.
  std::optional<double> by_default = {};
};
std::vector<Goal> goals();

struct GoalCell {
  std::optional<double> measured;
  std::optional<double> bar;
  bool at_least = false;
  /// Only where there is a bar; what could not be measured has not reached it.
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
