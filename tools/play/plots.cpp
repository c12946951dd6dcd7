#include "tools/play/plots.h"

#include <array>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "common/io/text_file.h"
#include "tools/charts/draw_charts.h"
#include "tools/play/report.h"

namespace puck {
namespace {

using PredictionBins = std::array<PredictionBin, PredictionReport::kBins>;

const char* fate_of(const ShotOutcome& outcome) {
  if (outcome.end == ShotOutcome::End::kSaved) return "saved";
  if (outcome.end == ShotOutcome::End::kUnjudged) return "not judged";
  return outcome.cause == GoalCause::kNotReachable ? "unreachable goal" : "goal";
}

nlohmann::json to_json(const PredictionBins& bins) {
  // With fewer, the 90th percentile is not meaningful.
  constexpr std::int64_t kFewest = 20;
  nlohmann::json json = nlohmann::json::array();
  for (const PredictionBin& bin : bins) {
    if (bin.predictions < kFewest) continue;
    json.push_back({{"from_s", bin.from_s},
                    {"to_s", bin.to_s},
                    {"predictions", bin.predictions},
                    {"median_mm", 1e3 * bin.median_m},
                    {"p90_mm", 1e3 * bin.p90_m}});
  }
  return json;
}

}  // namespace

void write_plot(const Sweep& sweep, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const std::string name = "saves_" + sweep.name + ".json";
  write_json(sweep, folder / name);
  draw_charts("play", {folder, name});
}

void write_plot(const std::vector<ShotFacts>& shots, const std::vector<ShotOutcome>& outcomes,
                const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ostringstream rows;
  rows << "speed_m_s,crossing_y_m,fate\n";
  for (std::size_t i = 0; i < shots.size(); ++i) {
    rows << shots[i].speed_m_s << ',' << shots[i].crossing_y_m << ',' << fate_of(outcomes[i])
         << '\n';
  }
  write_text_file(folder / "shots.csv", rows.str());
  draw_charts("play", {folder, "shots.csv"});
}

void write_plot(const PredictionReport& report, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const std::string name = "prediction.json";
  const nlohmann::ordered_json json{{"direct", to_json(report.direct)},
                                    {"by a rail", to_json(report.bounced)}};
  write_text_file(folder / name, json.dump(2) + '\n');
  draw_charts("play", {folder, name});
}

}  // namespace puck
