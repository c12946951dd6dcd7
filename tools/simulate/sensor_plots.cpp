#include "tools/simulate/sensor_plots.h"

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "common/io/text_file.h"
#include "tools/charts/draw_charts.h"
#include "tools/simulate/sensor_checks.h"

namespace puck {
namespace {

constexpr std::size_t kCumulativePoints = 1000;
constexpr std::array<double, 4> kLights_lux{30, 100, 300, 1000};

/// The measured curves in a file with the columns chart,curve,x,y.
class CurveFile {
 public:
  explicit CurveFile(const std::filesystem::path& path) : path_(path) {
    rows_ << "chart,curve,x,y\n";
  }

  void add(const std::string& chart, const Curve& curve) {
    for (const Curve::Point& point : curve.points) {
      rows_ << chart << ',' << curve.name << ',' << point.x << ',' << point.y << '\n';
    }
  }
  // Empirical distribution function, in about kCumulativePoints steps of equal size.
  void add_cumulative(const std::string& chart, const std::string& name,
                      const std::vector<double>& sorted) {
    const std::size_t step = 1 + sorted.size() / kCumulativePoints;
    Curve curve{name, {}};
    for (std::size_t i = step; i <= sorted.size(); i += step) {
      curve.points.push_back(
          {sorted[i - 1], static_cast<double>(i) / static_cast<double>(sorted.size())});
    }
    add(chart, curve);
  }
  void write() const { write_text_file(path_, rows_.str()); }

 private:
  std::filesystem::path path_;
  std::ostringstream rows_;
};

void add_light_dependence(SensorBench::Set set, CurveFile& file) {
  for (const double lux : kLights_lux) {
    const std::string name = std::to_string(std::lround(lux)) + " lux";
    set.light.illuminance_lux = lux;
    FrequencyResponse response = frequency_response(set);
    response.measured.name = name;
    file.add("frequency", response.measured);
    file.add_cumulative("latency", name, latency(set).delays_us);
    SensorBench::Set quiet = set;
    quiet.sensor.hot_pixel_fraction = 0;
    const Noise found = noise(quiet, 4);
    file.add("noise_rate", {"measured", {{lux, found.rate_hz}}});
    file.add("noise_balance", {"measured", {{lux, found.on_share}}});
  }
}

}  // namespace

void write_sensor_plots(const SensorBench::Set& set, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  CurveFile file(folder / "curves.csv");
  const StepResponse step = step_response(set, std::log(3.0));
  file.add("step", step.measured);
  file.add("step", step.expected);
  file.add("contrast", contrast_response(set));
  add_light_dependence(set, file);

  SensorBench::Set noisy = set;
  noisy.sensor.noise_hz = 50;
  noisy.sensor.hot_pixel_fraction = 0;
  file.add_cumulative("noise_intervals", "measured", noise(noisy, 1).intervals_s);
  file.add_cumulative("thresholds", "measured", thresholds(set));
  file.add_cumulative("refractory", "measured", refractory_intervals(set));

  const Saturation readout = saturation(set);
  file.add("saturation", readout.output_mev_s);
  file.add("saturation", readout.lost_share);
  file.add("burst", readout.burst);
  const Conservation conserved = conservation(set);
  file.add("conservation", conserved.light);
  file.add("conservation", conserved.sum);
  file.write();
  draw_charts("sensor", {folder});
}

}  // namespace puck
