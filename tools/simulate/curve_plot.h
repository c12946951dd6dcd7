#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tools/simulate/sensor_checks.h"

namespace puck {

/// A chart of curves over one pair of axes, fitted to the curves.
class CurvePlot {
 public:
  CurvePlot(std::string title, std::string x_label)
      : title_(std::move(title)), x_label_(std::move(x_label)) {}

  void add(Curve curve) { curves_.push_back(std::move(curve)); }
  /// For positive x only.
  void make_x_logarithmic() { log_x_ = true; }
  /// As PNG. Throws std::runtime_error if the file cannot be written.
  void save(const std::filesystem::path& path) const;

 private:
  std::string title_;
  std::string x_label_;
  bool log_x_ = false;
  std::vector<Curve> curves_;
};

}  // namespace puck
