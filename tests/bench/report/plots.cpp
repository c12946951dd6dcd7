#include "tests/bench/report/plots.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/plot/chart.h"

namespace puck {
namespace {

struct Curve {
  std::string name;
  std::vector<Chart::Point> points;
};

void draw(const std::string& title, Axis x, const std::string& y_label,
          const std::vector<Curve>& curves, const std::filesystem::path& path) {
  double smallest = 1e300;
  double largest = 0;
  for (const Curve& curve : curves) {
    for (const Chart::Point& point : curve.points) {
      smallest = std::min(smallest, point.y);
      largest = std::max(largest, point.y);
    }
  }
  if (largest <= 0) return;
  Chart chart(title, std::move(x), logarithmic_axis(y_label, smallest, largest));
  std::size_t number = 0;
  for (const Curve& curve : curves) {
    const Ink ink = series_ink(number++);
    if (curve.points.empty()) continue;
    chart.line(curve.points, ink);
    for (const Chart::Point& point : curve.points) chart.mark(point, "", ink);
    chart.legend(curve.name, ink);
  }
  chart.save(path);
}

// The share of a core at a rate, from the highest possible rate.
void add_share(double rate_mev_s, const Measurement* measurement, Curve& curve) {
  if (measurement == nullptr || !measurement->items_per_s) return;
  curve.points.push_back({rate_mev_s, 100 * rate_mev_s * 1e6 / *measurement->items_per_s});
}

void add_load(double rate_mev_s, const Measurement* measurement, Curve& curve) {
  if (measurement == nullptr) return;
  curve.points.push_back({rate_mev_s, measurement->counters.at("core_percent")});
}

void write_rates(const BenchmarkOutput& output, const std::filesystem::path& path) {
  Curve all{"preset default", {}};
  Curve correlation{"preset correlation", {}};
  Curve surface{"surface alone, k = 5", {}};
  Curve opencv{"surface alone in OpenCV", {}};
  for (const int kev_s : {100, 300, 1'000, 3'000, 10'000, 20'000}) {
    const double rate = kev_s * 1e-3;
    const std::string rate_name = "_" + std::to_string(kev_s) + "kev";
    add_load(rate, output.find("load_default" + rate_name, "ours"), all);
    add_load(rate, output.find("load_correlation" + rate_name, "ours"), correlation);
    add_share(rate, output.find("eros_k5_scene", "ours"), surface);
    add_share(rate, output.fastest("eros_k5_scene", "opencv"), opencv);
  }
  draw("surface and 5000 tracking steps a second, simulated scene",
       {.label = "events, Mev/s", .from = 0.08, .to = 25, .logarithmic = true},
       "share of a core, %", {all, correlation, surface, opencv}, path);
}

void write_half_widths(const BenchmarkOutput& output, const std::filesystem::path& path) {
  const std::vector<std::pair<std::string, std::string>> variants{
      {"ours", "ours"},
      {"opencv_8u", "OpenCV, 8 bits"},
      {"opencv_64f", "OpenCV, double"},
      {"plain_8u", "plain, 8 bits"},
      {"plain_8u_fixed", "plain, fixed"},
      {"plain_32f", "plain, float"}};
  std::vector<Curve> curves;
  for (const auto& [variant, name] : variants) {
    Curve curve{name, {}};
    for (int k = 1; k <= 8; ++k) {
      const Measurement* const found =
          output.find("eros_k" + std::to_string(k) + "_scene", variant);
      if (found == nullptr || !found->items_per_s) continue;
      curve.points.push_back({static_cast<double>(k), *found->items_per_s * 1e-6});
    }
    curves.push_back(curve);
  }
  draw("surface, simulated scene, one core", {.label = "half width k, px", .from = 0.5, .to = 8.5},
       "Mev/s", curves, path);
}

void write_sizes(const BenchmarkOutput& output, const std::filesystem::path& path) {
  constexpr int kLargestPx = 100;
  Curve round{"whole step, round pucks", {}};
  for (int px = 1; px <= kLargestPx; ++px) {
    const Measurement* const found = output.find("step_size_" + std::to_string(px), "ours");
    if (found != nullptr) {
      round.points.push_back({static_cast<double>(px), found->time_of_work_us()});
    }
  }
  Curve ours{"blur to maximum, far, middle, near", {}};
  Curve opencv{"the same in OpenCV", {}};
  for (const auto& [figure, width_px] :
       {std::pair("step_far", 19), std::pair("step_mid", 41), std::pair("step_near", 65)}) {
    for (const auto& [found, curve] : {std::pair(output.find(figure, "ours"), &ours),
                                       std::pair(output.fastest(figure, "opencv"), &opencv)}) {
      if (found == nullptr) continue;
      curve->points.push_back({static_cast<double>(width_px), found->time_of_work_us()});
    }
  }
  draw("a tracking step, reference kernels",
       {.label = "width of the kernel, px", .from = 0, .to = kLargestPx}, "CPU time, us",
       {round, ours, opencv}, path);
}

}  // namespace

void write_plots(const BenchmarkOutput& output, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_rates(output, folder / "cost-against-rate.png");
  write_half_widths(output, folder / "surface-against-k.png");
  write_sizes(output, folder / "step-against-size.png");
}

}  // namespace puck
