#include "tools/compare/summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/evaluation/quantile.h"
#include "tools/compare/program.h"

namespace puck {
namespace {

// Weighted mean of the known values.
class WeightedMean {
 public:
  void add(std::optional<double> value, double weight) {
    if (!value) return;
    sum_ += *value * weight;
    weight_ += weight;
  }
  std::optional<double> value() const {
    if (weight_ <= 0) return std::nullopt;
    return sum_ / weight_;
  }

 private:
  double sum_ = 0;
  double weight_ = 0;
};

std::optional<double> mean_by_ticks(const std::vector<const RunFigures*>& runs, const char* key) {
  WeightedMean mean;
  for (const RunFigures* run : runs) mean.add(run->number(key), run->ticks());
  return mean.value();
}

std::optional<double> mean_by_time(const std::vector<const RunFigures*>& runs, const char* key) {
  WeightedMean mean;
  for (const RunFigures* run : runs) {
    mean.add(run->number(key), run->number("duration_s").value_or(0));
  }
  return mean.value();
}

// Standard deviation over all ticks, from the means and deviations of the sequences.
std::optional<double> pooled_deviation(const std::vector<const RunFigures*>& runs) {
  WeightedMean mean;
  WeightedMean square;
  for (const RunFigures* run : runs) {
    const auto mean_px = run->number("mean_px");
    const auto std_px = run->number("std_px");
    if (!mean_px || !std_px) continue;
    mean.add(mean_px, run->ticks());
    square.add(*std_px * *std_px + *mean_px * *mean_px, run->ticks());
  }
  if (!mean.value()) return std::nullopt;
  return std::sqrt(std::max(*square.value() - *mean.value() * *mean.value(), 0.0));
}

std::vector<double> sorted_values(const std::vector<const RunFigures*>& runs, const char* key) {
  std::vector<double> values;
  for (const RunFigures* run : runs) {
    if (const auto value = run->number(key)) values.push_back(*value);
  }
  std::sort(values.begin(), values.end());
  return values;
}

std::optional<double> standard_error(const std::vector<double>& values) {
  if (values.size() < 2) return std::nullopt;
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (count - 1) / count);
}

}  // namespace

Summary summarise(const std::vector<const RunFigures*>& runs) {
  Summary summary;
  summary.sequences = static_cast<int>(runs.size());
  for (const RunFigures* run : runs) summary.ticks += static_cast<std::int64_t>(run->ticks());
  summary.mean_px = mean_by_ticks(runs, "mean_px");
  summary.std_px = pooled_deviation(runs);
  summary.within_3p5px_percent = mean_by_ticks(runs, "within_3p5px_percent");
  summary.within_4px_percent = mean_by_ticks(runs, "within_4px_percent");
  summary.lost_percent = mean_by_ticks(runs, "lost_percent");
  summary.said_and_wrong_percent = mean_by_time(runs, "said_and_wrong_percent");
  summary.nees_mean = mean_by_ticks(runs, "nees_mean");
  summary.nees_median = mean_by_ticks(runs, "nees_median");
  summary.nees_within_95_percent = mean_by_ticks(runs, "nees_within_95_percent");
  if (const auto means = sorted_values(runs, "mean_px"); !means.empty()) {
    summary.mean_px_standard_error = standard_error(means);
    summary.median_mean_px = quantile(means, 0.5);
    summary.worst_mean_px = means.back();
  }
  summary.lost_percent_standard_error = standard_error(sorted_values(runs, "lost_percent"));
  if (const auto losses = sorted_values(runs, "longest_loss_ms"); !losses.empty()) {
    summary.longest_loss_ms = losses.back();
  }
  if (const auto first = sorted_values(runs, "time_to_first_track_ms");
      !first.empty() && first.size() == runs.size()) {
    summary.time_to_first_track_ms = first.back();
  }
  summary.cpu_us_per_ms = mean_by_time(runs, "cpu_us_per_ms");
  summary.mev_s = mean_by_time(runs, "mev_s");
  return summary;
}

Comparison::Comparison(const ExperimentResults& results) : recordings_(results.recordings) {
  for (const Result& result : results.results) runs_.emplace_back(result);
  std::stable_sort(runs_.begin(), runs_.end(), [](const RunFigures& a, const RunFigures& b) {
    return a.result().seed < b.result().seed;
  });
}

std::vector<const RunFigures*> Comparison::runs(const std::vector<std::string>& sets,
                                                const std::string& contestant) const {
  std::vector<const RunFigures*> found;
  for (const RunFigures& run : runs_) {
    if (run.result().contestant != contestant) continue;
    if (std::find(sets.begin(), sets.end(), run.result().set) == sets.end()) continue;
    found.push_back(&run);
  }
  return found;
}

Summary Comparison::summary(const std::vector<std::string>& sets,
                            const std::string& contestant) const {
  return summarise(runs(sets, contestant));
}

Summary Comparison::summary(const std::string& set, const std::string& contestant) const {
  return summary(std::vector<std::string>{set}, contestant);
}

std::optional<double> Comparison::simulation_cost(const std::string& set) const {
  WeightedMean cost;
  for (const RecordingResult& recording : recordings_) {
    if (recording.set != set) continue;
    const auto json = nlohmann::json::parse(read_whole_file(recording.folder / "simulation.json"));
    cost.add(json.at("cpu_s").get<double>() / recording.seconds, recording.seconds);
  }
  return cost.value();
}

}  // namespace puck
