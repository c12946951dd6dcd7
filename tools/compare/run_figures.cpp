#include "tools/compare/run_figures.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "common/evaluation/truth_track.h"
#include "common/io/csv_file.h"
#include "common/io/truth_file.h"
#include "tools/compare/program.h"

namespace puck {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Reads a number up to a comma and skips the comma; NaN for an empty field.
double take_number(const char*& text) {
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  const bool found = end != text;
  text = *end == ',' ? end + 1 : end;
  return found ? value : kUnknown;
}

}  // namespace

RunFigures::RunFigures(const Result& result) : result_(result) {
  const std::filesystem::path path = result.folder / "figures.json";
  try {
    json_ = nlohmann::ordered_json::parse(read_whole_file(path));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

std::optional<double> RunFigures::number(const std::string& key) const {
  const auto found = json_.find(key);
  if (found == json_.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::optional<Chart::Box> RunFigures::box() const {
  if (ticks() == 0) return std::nullopt;
  return Chart::Box{number("p5_px").value(), number("p25_px").value(), number("median_px").value(),
                    number("p75_px").value(), number("p95_px").value()};
}

std::vector<Chart::Point> RunFigures::within() const {
  constexpr std::array<CsvColumn, 2> kColumns{{{"limit_px"}, {"percent"}}};
  std::vector<Chart::Point> curve;
  if (ticks() == 0) return curve;
  for (const CsvRow& row : read_csv(result_.folder / "within.csv", kColumns)) {
    curve.push_back({row.values[0], row.values[1]});
  }
  return curve;
}

ScoreCurve RunFigures::score_curve() const {
  constexpr std::array<CsvColumn, 2> kColumns{{{"believed"}, {"right"}}};
  ScoreCurve curve;
  if (ticks() == 0) return curve;
  const std::vector<CsvRow> rows = read_csv(result_.folder / "score.csv", kColumns);
  if (rows.size() != ScoreCurve::kSteps + 1) {
    throw std::runtime_error((result_.folder / "score.csv").string() + ": not " +
                             std::to_string(ScoreCurve::kSteps + 1) + " rows");
  }
  // The file holds cumulative counts above each threshold.
  std::array<double, 2> above{};
  for (int step = ScoreCurve::kSteps; step >= 0; --step) {
    const auto& values = rows[static_cast<std::size_t>(step)].values;
    curve.add_counts(step, std::llround(values[0] - above[0]), std::llround(values[1] - above[1]));
    above = {values[0], values[1]};
  }
  return curve;
}

Trajectory read_ticks(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || !line.starts_with("t_us,x,y,")) {
    throw std::runtime_error(path.string() + ":1: expected a header t_us,x,y,...");
  }
  Trajectory trajectory;
  while (std::getline(file, line)) {
    const char* text = line.c_str();
    const double t_us = take_number(text);
    const double x = take_number(text);
    const double y = take_number(text);
    trajectory.rows.push_back({t_us * 1e-6, x, y});
  }
  return trajectory;
}

Trajectory read_true_trajectory(const std::filesystem::path& path) {
  Trajectory trajectory;
  for (const TruthRow& row : read_truth_file(path)) {
    const bool seen = is_visible(row);
    trajectory.rows.push_back({static_cast<double>(row.time.us) * 1e-6,
                               seen ? row.centre.x : kUnknown, seen ? row.centre.y : kUnknown});
  }
  return trajectory;
}

}  // namespace puck
