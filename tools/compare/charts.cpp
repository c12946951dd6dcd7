#include "tools/compare/charts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/compare/trajectory_charts.h"

namespace puck {
namespace {

// Finer and coarser errors than these do not differ on the box plots.
constexpr double kSmallestErrorPx = 0.01;
constexpr double kLargestErrorPx = 100;
constexpr double kWithinShownPx = 10;
constexpr double kSmallestLostPercent = 0.01;

void add_legend(Chart& chart) {
  std::size_t number = 0;
  for (const Contestant& contestant : contestants()) {
    chart.legend(contestant.name, series_ink(number++));
  }
}

// Where the n-th contestant's box or bar lies in the group that begins at `group`.
double place_in_group(std::size_t group, std::size_t n) {
  const auto count = static_cast<double>(contestants().size());
  return static_cast<double>(group) + 0.1 + 0.8 * (static_cast<double>(n) + 0.5) / count;
}
double half_width_in_group() { return 0.32 / static_cast<double>(contestants().size()); }

ChartSize size_of_groups(std::size_t groups) {
  return {std::clamp(200 + 150 * static_cast<int>(groups), 1100, 1800), 520};
}

void write_box_plot(const SequenceSet& set, const ComparisonReport& report,
                    const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (int i = 0; i < sequences_of(set, report.options); ++i) {
    names.push_back("seed " + std::to_string(set.first_seed + i));
  }
  Chart chart("error of each sequence, " + set.title +
                  ": quartiles and median; whiskers from 5 to 95 %",
              {.label = "sequence", .things = names},
              logarithmic_axis("error, px", kSmallestErrorPx, kLargestErrorPx),
              size_of_groups(names.size()));
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

// Of all ticks of the runs.
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

// The last word goes below the others.
std::string in_two_lines(std::string name) {
  const std::size_t dash = name.rfind('-');
  if (dash != std::string::npos) name[dash] = '\n';
  return name;
}

Chart bars_of_all_sets(const std::string& title, const Axis& axis,
                       std::optional<double> Summary::*value, const ComparisonReport& report) {
  const std::vector<SequenceSet> sets = sequence_sets();
  std::vector<std::string> names;
  for (const SequenceSet& set : sets) names.push_back(in_two_lines(set.name));
  Chart chart(title, {.things = names}, axis, {1800, 460});
  add_legend(chart);
  for (std::size_t group = 0; group < sets.size(); ++group) {
    std::size_t number = 0;
    for (const Contestant& contestant : contestants()) {
      const auto measured = report.comparison.summary(sets[group].name, contestant.name).*value;
      if (measured) {
        chart.bar(place_in_group(group, number), half_width_in_group(), *measured, "",
                  series_ink(number));
      }
      ++number;
    }
  }
  return chart;
}

void write_hard(const ComparisonReport& report, const std::filesystem::path& folder) {
  save_stacked({bars_of_all_sets("mean error of every set",
                                 logarithmic_axis("error, px", 0.1, kLargestErrorPx),
                                 &Summary::mean_px, report),
                bars_of_all_sets("lost: more than 20 px off or not tracking",
                                 logarithmic_axis("lost, %", kSmallestLostPercent, 100),
                                 &Summary::lost_percent, report)},
               folder / "hard.png");
}

void write_score(const ComparisonReport& report, const std::filesystem::path& folder) {
  std::vector<std::string> sets;
  for (const SequenceSet& set : sequence_sets()) sets.push_back(set.name);
  Chart chart("believing scores from a threshold on, all sets (ring: best F1)",
              {.label = "recall: positions within 4 px that are believed, %", .to = 102},
              {.label = "precision: within 4 px, %", .from = 40, .to = 102});
  add_legend(chart);
  std::size_t number = 0;
  for (const Contestant& contestant : contestants()) {
    const Ink ink = series_ink(number++);
    ScoreCurve curve;
    for (const RunFigures* run : report.comparison.runs(sets, contestant.name)) {
      curve.add(run->score_curve());
    }
    std::vector<Chart::Point> points;
    for (int step = 0; step <= ScoreCurve::kSteps; ++step) {
      points.push_back({100 * curve.at(step).recall, 100 * curve.at(step).precision});
    }
    chart.line(points, ink);
    const auto best = curve.best();
    if (contestant.name == "default" && curve.ticks() > 0) {
      chart.mark({100 * best.recall, 100 * best.precision},
                 "default: score >= " + number_text(best.threshold, 3), ink);
    }
  }
  chart.save(folder / "score.png");
}

}  // namespace

void write_charts(const ComparisonReport& report, const std::filesystem::path& folder) {
  for (const SequenceSet& set : sequence_sets()) {
    if (set.is_hard) continue;
    write_box_plot(set, report, folder);
    write_within(set, report, folder);
  }
  write_trajectories(report.comparison, folder);
  write_hard(report, folder);
  write_score(report, folder);
  write_latency(report, folder);
}

}  // namespace puck
