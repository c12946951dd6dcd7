#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/evaluation/score_curve.h"
#include "common/plot/chart.h"
#include "tools/compare/experiment.h"

namespace puck {

/// The figures of one run of puck-evaluate.
class RunFigures {
 public:
  /// Throws std::runtime_error when the figures cannot be read.
  explicit RunFigures(const Result& result);

  const Result& result() const { return result_; }
  const nlohmann::ordered_json& json() const { return json_; }
  /// The value of a key in puck-evaluate's JSON; empty if null or missing.
  std::optional<double> number(const std::string& key) const;
  /// Scored ticks.
  double ticks() const { return number("estimates").value_or(0); }
  std::optional<Chart::Box> box() const;

  /// (limit in px, percent of the ticks within); empty without scored ticks.
  std::vector<Chart::Point> within() const;
  ScoreCurve score_curve() const;

 private:
  Result result_;
  nlohmann::ordered_json json_;
};

/// Estimated or true positions over sensor time, s.
struct Trajectory {
  struct Row {
    double time_s = 0;
    double x = 0;  ///< NaN without a position.
    double y = 0;
  };
  std::vector<Row> rows;
};
/// Reads the file of `puck-evaluate --csv`. Throws std::runtime_error.
Trajectory read_ticks(const std::filesystem::path& path);
/// Reads a truth file, only the rows in which the puck is visible.
Trajectory read_true_trajectory(const std::filesystem::path& path);

}  // namespace puck
