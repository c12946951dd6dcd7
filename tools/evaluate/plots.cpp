#include "tools/evaluate/plots.h"

#include <algorithm>
#include <functional>
#include <sstream>
#include <vector>

#include "common/io/text_file.h"
#include "tools/charts/draw_charts.h"

namespace puck {
namespace {

constexpr double kTableEndPx = 20;
constexpr double kTableStepPx = 0.05;

void write_table(const std::filesystem::path& path,
                 const std::function<void(std::ostream&)>& write_rows) {
  std::ostringstream rows;
  write_rows(rows);
  write_text_file(path, rows.str());
}

void write_within(std::span<const ScoredEstimate> estimates, std::ostream& file) {
  std::vector<double> sorted;
  for (const auto& sample : estimates) sorted.push_back(sample.error_px);
  std::sort(sorted.begin(), sorted.end());
  file << "limit_px,percent\n";
  for (int i = 0; i * kTableStepPx <= kTableEndPx; ++i) {
    const double limit_px = i * kTableStepPx;
    const auto beyond = std::upper_bound(sorted.begin(), sorted.end(), limit_px);
    file << limit_px << ','
         << 100 * static_cast<double>(beyond - sorted.begin()) / static_cast<double>(sorted.size())
         << '\n';
  }
}

void write_score(const ScoreCurve& curve, std::ostream& file) {
  file << "threshold,believed,right,precision,recall\n";
  for (int step = 0; step <= ScoreCurve::kSteps; ++step) {
    const auto point = curve.at(step);
    file << point.threshold << ',' << point.believed << ',' << point.right << ',' << point.precision
         << ',' << point.recall << '\n';
  }
}

}  // namespace

void write_curves(std::span<const ScoredEstimate> estimates, const std::filesystem::path& folder) {
  write_table(folder / "within.csv", [&](std::ostream& file) { write_within(estimates, file); });
  write_table(folder / "score.csv", [&](std::ostream& file) {
    write_score(error_statistics(estimates).score_curve, file);
  });
}

void write_plots(std::span<const ScoredEstimate> estimates, const std::filesystem::path& folder) {
  write_curves(estimates, folder);
  write_table(folder / "error.csv", [&](std::ostream& file) {
    file << "t_us,error_px\n";
    for (const auto& sample : estimates) file << sample.tick.us << ',' << sample.error_px << '\n';
  });
  draw_charts("evaluate", {folder});
}

}  // namespace puck
