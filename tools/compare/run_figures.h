#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

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

 private:
  Result result_;
  nlohmann::ordered_json json_;
};

}  // namespace puck
