#include "tools/simulate/sensor_plots.h"

#include <array>
#include <cmath>
#include <string>

#include "tools/simulate/curve_plot.h"
#include "tools/simulate/sensor_checks.h"

namespace puck {
namespace {

constexpr std::array<double, 4> kLights_lux{30, 100, 300, 1000};

std::string lux_of(const SensorBench::Set& set) {
  return std::to_string(static_cast<int>(std::lround(set.light.illuminance_lux))) + " lux";
}

// Empirical distribution function.
Curve cumulative(std::string name, const std::vector<double>& sorted) {
  Curve curve{std::move(name), {}};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    curve.points.push_back(
        {sorted[i], static_cast<double>(i + 1) / static_cast<double>(sorted.size())});
  }
  return curve;
}

void plot_light_dependence(SensorBench::Set set, const std::filesystem::path& folder) {
  CurvePlot bode("events per cycle, as a share of those at low frequency", "Hz");
  CurvePlot delays("pixels that have answered a step of 1.5 thresholds", "us");
  CurvePlot rate("noise of a pixel, Hz", "lux");
  CurvePlot balance("share of ON among noise events", "lux");
  bode.make_x_logarithmic();
  delays.make_x_logarithmic();
  rate.make_x_logarithmic();
  balance.make_x_logarithmic();
  Curve rates{"measured", {}};
  Curve shares{"measured", {}};
  for (const double lux : kLights_lux) {
    set.light.illuminance_lux = lux;
    FrequencyResponse response = frequency_response(set);
    response.measured.name = lux_of(set);
    bode.add(response.measured);
    delays.add(cumulative(lux_of(set), latency(set).delays_us));
    SensorBench::Set quiet = set;
    quiet.sensor.hot_pixel_fraction = 0;
    const Noise found = noise(quiet, 4);
    rates.points.push_back({lux, found.rate_hz});
    shares.points.push_back({lux, found.on_share});
  }
  rate.add(rates);
  balance.add(shares);
  bode.save(folder / "frequency.png");
  delays.save(folder / "latency.png");
  rate.save(folder / "noise_rate.png");
  balance.save(folder / "noise_balance.png");
}

}  // namespace

void write_sensor_plots(const SensorBench::Set& set, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);

  const StepResponse step = step_response(set, std::log(3.0));
  CurvePlot steps("pixels by number of events after a step to three times the light", "events");
  steps.add(step.measured);
  steps.add(step.expected);
  steps.save(folder / "step.png");

  CurvePlot contrast("events per cycle of a slow sinusoid", "swing of ln(light)");
  contrast.add(contrast_response(set));
  contrast.save(folder / "contrast.png");

  plot_light_dependence(set, folder);

  SensorBench::Set noisy = set;
  noisy.sensor.noise_hz = 50;
  noisy.sensor.hot_pixel_fraction = 0;
  CurvePlot intervals("intervals between noise events of a pixel at 50 Hz, cumulative", "s");
  intervals.add(cumulative("measured", noise(noisy, 1).intervals_s));
  intervals.save(folder / "noise_intervals.png");

  CurvePlot mismatch("S-curve: pixels that have fired again", "growth of ln(light)");
  mismatch.add(cumulative("measured", thresholds(set)));
  mismatch.save(folder / "thresholds.png");

  CurvePlot refractory("intervals in light that changes too fast, cumulative", "us");
  refractory.make_x_logarithmic();
  refractory.add(cumulative("measured", refractory_intervals(set)));
  refractory.save(folder / "refractory.png");

  const Saturation readout = saturation(set);
  CurvePlot saturated("readout of 1 Mev/s", "Mev/s made");
  saturated.add(readout.output_mev_s);
  saturated.add(readout.lost_share);
  saturated.save(folder / "saturation.png");
  CurvePlot burst("share of simultaneous events that have left at 1 Mev/s", "us");
  burst.add(readout.burst);
  burst.save(folder / "burst.png");

  const Conservation conserved = conservation(set);
  CurvePlot sums("ln(light) and the sum of signed events", "s");
  sums.add(conserved.light);
  sums.add(conserved.sum);
  sums.save(folder / "conservation.png");
}

}  // namespace puck
