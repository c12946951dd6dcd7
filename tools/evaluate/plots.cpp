#include "tools/evaluate/plots.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

#include "common/plot/chart.h"

namespace puck {
namespace {

// The curves end at this error.
constexpr double kShownPx = 10;
constexpr double kTableEndPx = 20;
constexpr double kTableStepPx = 0.05;

void write_table(const std::filesystem::path& path,
                 const std::function<void(std::ofstream&)>& write_rows) {
  std::ofstream file(path);
  write_rows(file);
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

std::vector<double> sorted_errors(std::span<const ScoredEstimate> estimates) {
  std::vector<double> sorted;
  for (const auto& sample : estimates) sorted.push_back(sample.error_px);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

void plot_error(std::span<const ScoredEstimate> estimates, const std::filesystem::path& folder) {
  std::vector<Chart::Point> over_time;
  for (const auto& sample : estimates) {
    over_time.push_back({static_cast<double>(sample.tick.us) * 1e-6, sample.error_px});
  }
  const double begin_s = over_time.front().x;
  const double end_s = std::max(over_time.back().x, begin_s + 1e-3);
  Chart chart("error over time (cut at 10 px)",
              {.label = "sensor time, s", .from = begin_s, .to = end_s},
              {.label = "error, px", .to = kShownPx});
  chart.line(over_time, series_ink(4), 1);
  chart.save(folder / "error.png");
}

void plot_within(const std::vector<double>& sorted, const std::filesystem::path& folder) {
  std::vector<Chart::Point> curve;
  write_table(folder / "within.csv", [&](std::ofstream& file) {
    file << "limit_px,percent\n";
    for (int i = 0; i * kTableStepPx <= kTableEndPx; ++i) {
      const double limit_px = i * kTableStepPx;
      const auto beyond = std::upper_bound(sorted.begin(), sorted.end(), limit_px);
      const double percent =
          100 * static_cast<double>(beyond - sorted.begin()) / static_cast<double>(sorted.size());
      file << limit_px << ',' << percent << '\n';
      curve.push_back({limit_px, percent});
    }
  });
  Chart chart("ticks within an error", {.label = "error, px", .to = kShownPx},
              {.label = "ticks, %", .to = 100});
  chart.line(curve, series_ink(4));
  chart.save(folder / "within.png");
}

void plot_score(const ScoreCurve& curve, const std::filesystem::path& folder) {
  std::vector<Chart::Point> precision;
  std::vector<Chart::Point> recall;
  write_table(folder / "score.csv", [&](std::ofstream& file) {
    file << "threshold,believed,right,precision,recall\n";
    for (int step = 0; step <= ScoreCurve::kSteps; ++step) {
      const auto point = curve.at(step);
      file << point.threshold << ',' << point.believed << ',' << point.right << ','
           << point.precision << ',' << point.recall << '\n';
      precision.push_back({point.threshold, 100 * point.precision});
      recall.push_back({point.threshold, 100 * point.recall});
    }
  });
  char title[96];
  std::snprintf(title, sizeof title,
                "precision and recall by score threshold; best F1 at %.3f, area %.4f",
                curve.best().threshold, curve.average_precision());
  Chart chart(title, {.label = "threshold"}, {.label = "%", .to = 105});
  const double best = curve.best().threshold;
  chart.line({{best, 0}, {best, 105}}, kGrey, 1);
  chart.legend("precision: believed ticks that are within 4 px", series_ink(4));
  chart.line(precision, series_ink(4));
  chart.legend("recall: ticks within 4 px that are believed", series_ink(5));
  chart.line(recall, series_ink(5));
  chart.save(folder / "score.png");
}

}  // namespace

void write_plots(std::span<const ScoredEstimate> estimates, const std::filesystem::path& folder) {
  if (estimates.empty()) throw std::runtime_error("nothing to plot: no tick counts");
  std::filesystem::create_directories(folder);
  plot_error(estimates, folder);
  plot_within(sorted_errors(estimates), folder);
  plot_score(error_statistics(estimates).score_curve, folder);
}

}  // namespace puck
