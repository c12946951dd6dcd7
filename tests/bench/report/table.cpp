#include <algorithm>
#include <cstdio>

#include "tests/bench/report/bars.h"
#include "tests/bench/report/figures.h"

namespace puck {
namespace {

constexpr const char* kSpread = "_spread_percent";

std::string word(const BenchFigures& figures, const std::string& key) {
  const auto found = figures.words.find(key);
  return found == figures.words.end() ? "unknown" : found->second;
}

const char* verdict(const Bar& bar, const std::optional<double>& value) {
  if (!value) return "NOT MEASURED";
  if (bar.kind == Bar::Kind::kReport) return "";
  return bar.is_met_by(*value) ? "met" : "MISSED";
}

// With as many digits as are significant.
std::string number_or_none(const std::optional<double>& value) {
  if (!value) return "-";
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", *value < 10 ? 2 : *value < 1000 ? 1 : 0, *value);
  return text;
}

// Spread of a figure's repetitions; a key begins with its figure's name.
std::string spread(const BenchFigures& figures, std::string key) {
  for (auto end = key.rfind('_'); end != std::string::npos; end = key.rfind('_')) {
    key.resize(end);
    if (const auto percent = figures.find(key + kSpread))
      return "+-" + number_or_none(percent) + " %";
  }
  return "";
}

bool is_held(const std::string& key) {
  return std::any_of(bars().begin(), bars().end(), [&](const Bar& bar) { return bar.key == key; });
}

}  // namespace

void print(const BenchFigures& figures) {
  std::printf("%s, %.0f cores, instruction set %s; OpenCV %s on one thread\n\n",
              word(figures, "cpu_model").c_str(), figures.find("cores").value_or(0),
              word(figures, "highway_target").c_str(), word(figures, "opencv_version").c_str());
  std::printf("%-26s %-41s %8s %9s  %-20s\n", "key", "figure", "value", "spread", "bar");
  for (const Bar& bar : bars()) {
    const auto value = figures.find(bar.key);
    std::printf("%-26s %-41s %8s %9s  %-20s %s\n", bar.key.c_str(), bar.what.c_str(),
                number_or_none(value).c_str(), value ? spread(figures, bar.key).c_str() : "",
                bar.text().c_str(), verdict(bar, value));
  }
  std::printf("\nBeside these:\n");
  for (const auto& [key, value] : figures.values) {
    if (is_held(key) || key.ends_with(kSpread) || key == "cores") continue;
    std::printf("  %-40s %10s %9s\n", key.c_str(), number_or_none(value).c_str(),
                spread(figures, key).c_str());
  }
  for (const auto& [key, words] : figures.words) {
    if (key.ends_with("_note")) std::printf("  %s: %s\n", key.c_str(), words.c_str());
  }
}

}  // namespace puck
