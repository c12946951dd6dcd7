#include "tools/compare/all_sets_charts.h"

#include "tools/compare/chart_groups.h"

namespace puck {
namespace {

constexpr double kSmallestErrorPx = 0.1;
constexpr double kLargestErrorPx = 100;
constexpr double kSmallestLostPercent = 0.01;

// Puts the last word on a second line.
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
                                 logarithmic_axis("error, px", kSmallestErrorPx, kLargestErrorPx),
                                 &Summary::mean_px, report),
                bars_of_all_sets("lost: more than 20 px off or not tracking",
                                 logarithmic_axis("lost, %", kSmallestLostPercent, 100),
                                 &Summary::lost_percent, report)},
               folder / "hard.png");
}

void write_covariance(const ComparisonReport& report, const std::filesystem::path& folder) {
  constexpr double kHonestPercent = 95;
  Chart chart =
      bars_of_all_sets("consistency of the covariance: tracked positions within its 95 % bound",
                       {.label = "ticks, %", .to = 100}, &Summary::nees_within_95_percent, report);
  const auto end = static_cast<double>(sequence_sets().size());
  chart.line({{0, kHonestPercent}, {end, kHonestPercent}}, kBlack, 1);
  chart.save(folder / "covariance.png");
}

// Without the second puck's set: both pucks deserve a score, but the truth holds one.
ScoreCurve pooled_score(const std::string& contestant, const ComparisonReport& report) {
  std::vector<std::string> sets;
  for (const SequenceSet& set : sequence_sets()) {
    if (set.name != "second-puck") sets.push_back(set.name);
  }
  ScoreCurve curve;
  for (const RunFigures* run : report.comparison.runs(sets, contestant)) {
    curve.add(run->score_curve());
  }
  return curve;
}

Chart precision_over_recall(const ComparisonReport& report) {
  Chart chart("precision and recall by threshold on the score, all sets but the second puck's",
              {.label = "recall: positions within 4 px that are believed, %", .to = 102},
              {.label = "precision: within 4 px, %", .from = 40, .to = 102});
  add_legend(chart);
  std::size_t number = 0;
  for (const Contestant& contestant : contestants()) {
    const ScoreCurve curve = pooled_score(contestant.name, report);
    std::vector<Chart::Point> points;
    for (int step = 0; step <= ScoreCurve::kSteps; ++step) {
      points.push_back({100 * curve.at(step).recall, 100 * curve.at(step).precision});
    }
    chart.line(points, series_ink(number++));
  }
  return chart;
}

Chart choice_of_threshold(const std::string& contestant, const ComparisonReport& report) {
  const ScoreCurve curve = pooled_score(contestant, report);
  const auto best = curve.best();
  std::vector<Chart::Point> precision;
  std::vector<Chart::Point> recall;
  for (int step = 0; step <= ScoreCurve::kSteps; ++step) {
    const auto point = curve.at(step);
    precision.push_back({point.threshold, 100 * point.precision});
    recall.push_back({point.threshold, 100 * point.recall});
  }
  Chart chart(contestant + ": best F1 with a threshold of " + number_text(best.threshold, 3) +
                  ", area " + number_text(curve.average_precision(), 4),
              {.label = "threshold on the score"}, {.label = "%", .to = 102});
  chart.line({{best.threshold, 0}, {best.threshold, 102}}, kGrey);
  chart.legend("precision", series_ink(4));
  chart.line(precision, series_ink(4));
  chart.legend("recall", series_ink(5));
  chart.line(recall, series_ink(5));
  return chart;
}

void write_score(const ComparisonReport& report, const std::filesystem::path& folder) {
  save_stacked({precision_over_recall(report), choice_of_threshold("default", report)},
               folder / "score.png");
}

}  // namespace

void write_all_sets_charts(const ComparisonReport& report, const std::filesystem::path& folder) {
  write_hard(report, folder);
  write_covariance(report, folder);
  write_score(report, folder);
}

}  // namespace puck
