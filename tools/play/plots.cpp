#include "tools/play/plots.h"

#include <array>
#include <fstream>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

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

void close(std::ofstream& file, const std::filesystem::path& path) {
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
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
  std::ofstream file(folder / "shots.csv");
  file << "speed_m_s,crossing_y_m,fate\n";
  for (std::size_t i = 0; i < shots.size(); ++i) {
    file << shots[i].speed_m_s << ',' << shots[i].crossing_y_m << ',' << fate_of(outcomes[i])
         << '\n';
  }
  close(file, folder / "shots.csv");
  draw_charts("play", {folder, "shots.csv"});
}

void write_plot(const PredictionReport& report, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const std::string name = "prediction.json";
  std::ofstream file(folder / name);
  file << nlohmann::ordered_json{{"direct", to_json(report.direct)},
                                 {"by a rail", to_json(report.bounced)}}
              .dump(2)
       << '\n';
  close(file, folder / name);
  draw_charts("play", {folder, name});
}

}  // namespace puck
