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

/// What puck-evaluate found in one run.
class RunFigures {
 public:
  /// Throws std::runtime_error when its figures cannot be read.
  explicit RunFigures(const Result& result);

  const Result& result() const { return result_; }
  const nlohmann::ordered_json& json() const { return json_; }
  /// By the key of puck-evaluate's JSON; nothing where that is null or missing.
  std::optional<double> number(const std::string& key) const;
  /// Ticks that count.
  double ticks() const { return number("estimates").value_or(0); }
  std::optional<Chart::Box> box() const;

  /// (limit in px, percent of the ticks within); empty where no tick counts.
  std::vector<Chart::Point> within() const;
  ScoreCurve score_curve() const;

 private:
  Result result_;
  nlohmann::ordered_json json_;
};

/// Where a run put the puck, and where it truly was, over sensor time in s.
struct Trajectory {
  struct Row {
    double time_s = 0;
    double x = 0;  ///< Not a number where there is no position.
    double y = 0;
  };
  std::vector<Row> rows;
};
/// Of `puck-evaluate --csv`. Throws std::runtime_error.
Trajectory read_ticks(const std::filesystem::path& path);
/// Only while the puck can be seen.
Trajectory read_true_trajectory(const std::filesystem::path& path);

}  // namespace puck
