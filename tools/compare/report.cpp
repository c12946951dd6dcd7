#include "tools/compare/report.h"

#include "common/io/text_file.h"
#include "tools/compare/report_json.h"

namespace puck {
namespace {

std::string slash(std::optional<double> a, int a_decimals, std::optional<double> b,
                  int b_decimals) {
  return number_text(a, a_decimals) + " / " + number_text(b, b_decimals);
}

TextTable goals_table(const Comparison& comparison) {
  TextTable table("Figures to reach",
                  {"", "reference", "correlation", "bar", "", "default", "bar", ""});
  for (const GoalResult& goal : check_goals(comparison)) {
    const auto bar = [](const GoalCell& cell) {
      if (!cell.bar) return std::string("report");
      return (cell.at_least ? ">= " : "<= ") + number_text(cell.bar, 2);
    };
    const auto verdict = [](const GoalCell& cell) -> std::string {
      const auto reached = cell.reached();
      return !reached ? "" : *reached ? "pass" : "FAIL";
    };
    table.add({goal.title, number_text(goal.reference.measured, 2),
               number_text(goal.correlation.measured, 2), bar(goal.correlation),
               verdict(goal.correlation), number_text(goal.by_default.measured, 2),
               bar(goal.by_default), verdict(goal.by_default)});
  }
  return table;
}

std::string title_of(const SequenceSet& set, const PlanOptions& options) {
  const int count = sequences_of(set, options);
  const std::string first = std::to_string(set.first_seed);
  const std::string last = std::to_string(set.first_seed + count - 1);
  return set.title + ": " + std::to_string(count) + " x " +
         number_text(seconds_of(set, options), 0) + " s, seed" +
         (count == 1 ? " " + first : "s " + first + " to " + last);
}

// From there on, the covariance is far too small; the exact value adds nothing.
std::string nees_text(std::optional<double> nees) {
  return nees && *nees > 999 ? "> 999" : number_text(nees, 2);
}

TextTable set_table(const SequenceSet& set, const ComparisonReport& report) {
  std::string title = title_of(set, report.options);
  if (!set.published.empty())
    title += " (the paper, on recordings of its own: " + set.published + ")";
  TextTable table(title,
                  {"", "mean px", "+-", "std px", "median seq.", "worst seq.", "in 3.5 px %",
                   "in 4 px %", "lost %", "+-", "said and wrong %", "longest ms", "first track ms",
                   "NEES mean", "median", "in 95 % bound", "CPU us/ms", "Mev/s"});
  for (const Contestant& contestant : contestants()) {
    const Summary s = report.comparison.summary(set.name, contestant.name);
    if (s.sequences == 0) continue;
    table.add({contestant.name, number_text(s.mean_px, 3), number_text(s.mean_px_standard_error, 3),
               number_text(s.std_px, 3), number_text(s.median_mean_px, 3),
               number_text(s.worst_mean_px, 3), number_text(s.within_3p5px_percent, 2),
               number_text(s.within_4px_percent, 2), number_text(s.lost_percent, 2),
               number_text(s.lost_percent_standard_error, 2),
               number_text(s.said_and_wrong_percent, 2), number_text(s.longest_loss_ms, 0),
               number_text(s.time_to_first_track_ms, 0), nees_text(s.nees_mean),
               nees_text(s.nees_median), number_text(s.nees_within_95_percent, 1),
               number_text(s.cpu_us_per_ms, 0), number_text(s.mev_s, 2)});
  }
  return table;
}

TextTable hard_table(const ComparisonReport& report) {
  const std::vector<Contestant> shown = report.options.included();
  std::vector<std::string> header{"mean px / lost %"};
  for (const Contestant& contestant : shown) header.push_back(contestant.name);
  TextTable table("All sets at a glance", header);
  for (const SequenceSet& set : sequence_sets()) {
    std::vector<std::string> row{set.title};
    for (const Contestant& contestant : shown) {
      const Summary s = report.comparison.summary(set.name, contestant.name);
      row.push_back(s.sequences == 0 ? "" : slash(s.mean_px, 2, s.lost_percent, 2));
    }
    table.add(row);
  }
  return table;
}

TextTable latency_table(const ComparisonReport& report) {
  TextTable table(
      "Latency in real time, from a packet's receipt to the estimate with its last event",
      {"", "median us", "99 % us"});
  for (const Contestant& contestant : contestants()) {
    for (const RunFigures* run : report.latency.runs({"latency"}, contestant.name)) {
      table.add({contestant.name, number_text(run->number("latency_p50_us"), 0),
                 number_text(run->number("latency_p99_us"), 0)});
    }
  }
  return table;
}

TextTable simulation_table(const ComparisonReport& report) {
  TextTable table("What the simulation costs", {"", "CPU s a second", "30 s take, s"});
  for (const SequenceSet& set : sequence_sets()) {
    const auto cost = report.comparison.simulation_cost(set.name);
    if (!cost) continue;
    table.add({set.title, number_text(cost, 2), number_text(30 * *cost, 0)});
  }
  return table;
}

}  // namespace

std::string seeds_text(const PlanOptions& options) {
  std::string text = options.scoring == "paper" ? "scored by the paper's rules\n" : "";
  text += "development: seeds 1 to 99; parameters are chosen on them. calibration: seed 1\n";
  for (const SequenceSet& set : sequence_sets()) text += "test: " + title_of(set, options) + '\n';
  return text;
}

std::vector<TextTable> report_tables(const ComparisonReport& report) {
  std::vector<TextTable> tables{goals_table(report.comparison), hard_table(report)};
  for (const SequenceSet& set : sequence_sets()) tables.push_back(set_table(set, report));
  tables.push_back(latency_table(report));
  tables.push_back(simulation_table(report));
  return tables;
}

void write_report(const ComparisonReport& report, const std::filesystem::path& folder) {
  std::string text = seeds_text(report.options);
  std::string markdown = "```\n" + text + "```\n";
  for (const TextTable& table : report_tables(report)) {
    text += '\n' + table.text();
    markdown += '\n' + table.markdown();
  }
  write_text_file(folder / "comparison.txt", text);
  write_text_file(folder / "comparison.md", markdown);
  write_text_file(folder / "comparison.json", report_json(report).dump(2) + '\n');
}

}  // namespace puck
