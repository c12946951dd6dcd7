#include "tests/bench/report/figures.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "tests/bench/report/bars.h"

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kBindingStream = "_scene";

// The scene's figures are those that bind: eros_k3_scene is called eros_k3.
std::string key_of(const std::string& figure) {
  return figure.starts_with("eros_k") && figure.ends_with(kBindingStream)
             ? figure.substr(0, figure.size() - std::string(kBindingStream).size())
             : figure;
}

void add_figure(const std::string& figure, const BenchmarkOutput& output, BenchFigures& figures) {
  const Measurement* const ours = output.find(figure, "ours");
  if (ours == nullptr) return;
  const std::string key = key_of(figure) + "_";
  std::map<std::string, double>& values = figures.values;
  if (ours->items_per_s) {
    values[key + "mev_s"] = *ours->items_per_s * 1e-6;
  } else {
    values[key + "us"] = ours->time_of_work_us();
  }
  values[key + "spread_percent"] = ours->spread_percent;
  for (const auto& [name, value] : ours->counters) {
    if (name != "steps") values[key + name] = value;
  }
  if (!ours->note.empty()) figures.words[key + "note"] = ours->note;
  const auto add_ratio = [&](const std::string& name, const Measurement* base) {
    if (base == nullptr) return;
    values[key + name] = base->time_of_work_us() / ours->time_of_work_us();
  };
  for (const auto& [variant, base] : output.figures.at(figure)) {
    if (variant != "ours") add_ratio(variant + "_ratio", &base);
  }
  add_ratio("ratio", output.fastest(figure, "opencv"));
  add_ratio("plain_ratio", output.fastest(figure, "plain"));
}

// Counts without a decimal point.
Json to_json(double value) {
  constexpr double kLargestExact = 9e15;
  const bool is_whole = value == std::floor(value) && std::abs(value) < kLargestExact;
  return is_whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

}  // namespace

std::optional<double> BenchFigures::find(const std::string& key) const {
  const auto found = values.find(key);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

BenchFigures figures_of(const BenchmarkOutput& output) {
  BenchFigures figures;
  figures.words = output.machine;
  figures.values["cores"] = output.cores;
  for (const auto& entry : output.figures) add_figure(entry.first, output, figures);
  return figures;
}

void add_flat_json(const std::filesystem::path& path, BenchFigures& figures) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  const Json json = Json::parse(file, nullptr, false);
  if (!json.is_object()) throw std::runtime_error(path.string() + ": is no JSON object");
  for (const auto& [key, value] : json.items()) {
    if (value.is_number()) {
      figures.values[key] = value;
    } else if (value.is_string()) {
      figures.words[key] = value;
    }
  }
}

std::vector<std::string> missing_keys(const BenchFigures& figures) {
  std::vector<std::string> missing;
  for (const Bar& bar : bars()) {
    if (!figures.find(bar.key)) missing.push_back(bar.key);
  }
  return missing;
}

void write_json(const BenchFigures& figures, const std::filesystem::path& path) {
  Json json;
  for (const Bar& bar : bars()) {
    const auto value = figures.find(bar.key);
    json[bar.key] = value ? to_json(*value) : Json(nullptr);
  }
  for (const auto& [key, words] : figures.words) json[key] = words;
  for (const auto& [key, value] : figures.values) json[key] = to_json(value);
  std::ofstream file(path);
  file << json.dump(2) << '\n';
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace puck
