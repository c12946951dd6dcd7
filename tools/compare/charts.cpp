#include "tools/compare/charts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/compare/all_sets_charts.h"
#include "tools/compare/chart_groups.h"
#include "tools/compare/trajectory_charts.h"

namespace puck {
namespace {

// The box plots cut errors at these limits.
constexpr double kSmallestBoxPx = 0.01;
constexpr double kLargestBoxPx = 100;
constexpr double kWithinShownPx = 10;

ChartSize size_of_groups(std::size_t groups) {
  return {std::clamp(200 + 150 * static_cast<int>(groups), 1100, 1800), 520};
}

void write_box_plot(const SequenceSet& set, const ComparisonReport& report,
                    const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (int i = 0; i < sequences_of(set, report.options); ++i) {
    names.push_back("seed " + std::to_string(set.first_seed + i));
  }
  Chart chart(
      "error of each sequence, " + set.title + ": quartiles and median; whiskers from 5 to 95 %",
      {.label = "sequence", .things = names},
      logarithmic_axis("error, px", kSmallestBoxPx, kLargestBoxPx), size_of_groups(names.size()));
  add_legend(chart);
  std::size_t number = 0;
  for (const Contestant& contestant : contestants()) {
    for (const RunFigures* run : report.comparison.runs({set.name}, contestant.name)) {
      const auto group = static_cast<std::size_t>(run->result().seed - set.first_seed);
      if (const auto box = run->box()) {
        chart.box(place_in_group(group, number), half_width_in_group(), *box, series_ink(number));
      }
    }
    ++number;
  }
  chart.save(folder / ("errors-" + set.name + ".png"));
}

// Over all ticks of the runs.
std::vector<Chart::Point> pooled_within(const std::vector<const RunFigures*>& runs) {
  std::vector<Chart::Point> pooled;
  double ticks = 0;
  for (const RunFigures* run : runs) {
    const std::vector<Chart::Point> curve = run->within();
    if (curve.empty()) continue;
    if (pooled.empty()) {
      for (const auto& point : curve) pooled.push_back({point.x, 0});
    }
    for (std::size_t i = 0; i < std::min(pooled.size(), curve.size()); ++i) {
      pooled[i].y += curve[i].y * run->ticks();
    }
    ticks += run->ticks();
  }
  for (auto& point : pooled) point.y /= ticks;
  return pooled;
}

void write_within(const SequenceSet& set, const ComparisonReport& report,
                  const std::filesystem::path& folder) {
  Chart chart("valid positions, " + set.title, {.label = "threshold, px", .to = kWithinShownPx},
              {.label = "positions within it, %", .to = 100});
  add_legend(chart);
  std::size_t number = 0;
  for (const Contestant& contestant : contestants()) {
    chart.line(pooled_within(report.comparison.runs({set.name}, contestant.name)),
               series_ink(number++));
  }
  chart.save(folder / ("within-" + set.name + ".png"));
}

void write_latency(const ComparisonReport& report, const std::filesystem::path& folder) {
  std::vector<std::string> names;
  double largest_us = 1;
  double smallest_us = 1e6;
  std::vector<std::optional<double>> medians;
  for (const Contestant& contestant : contestants()) {
    names.push_back(contestant.name);
    std::optional<double> median_us;
    for (const RunFigures* run : report.latency.runs({"latency"}, contestant.name)) {
      median_us = run->number("latency_p50_us");
    }
    medians.push_back(median_us);
    if (!median_us) continue;
    largest_us = std::max(largest_us, *median_us);
    smallest_us = std::min(smallest_us, std::max(*median_us, 1.0));
  }
  Chart chart("latency in real time: from a packet to the estimate with its last event, median",
              {.things = names}, logarithmic_axis("latency, us", smallest_us / 2, largest_us * 2));
  for (std::size_t i = 0; i < medians.size(); ++i) {
    if (!medians[i]) continue;
    chart.bar(static_cast<double>(i) + 0.5, 0.3, std::max(*medians[i], 1.0),
              number_text(medians[i], 0) + " us", series_ink(i));
  }
  chart.save(folder / "latency.png");
}

}  // namespace

void write_charts(const ComparisonReport& report, const std::filesystem::path& folder) {
  for (const SequenceSet& set : sequence_sets()) {
    if (set.is_hard) continue;
    write_box_plot(set, report, folder);
    write_within(set, report, folder);
  }
  write_trajectories(report.comparison, folder);
  write_all_sets_charts(report, folder);
  write_latency(report, folder);
}

}  // namespace puck
