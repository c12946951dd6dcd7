#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/simulate/sensor_checks.h"

namespace puck {

Noise noise(const SensorBench::Set& set, double seconds) {
  SensorBench bench(set);
  bench.wait(static_cast<std::int64_t>(seconds * 1e6));
  Noise result;
  const double count = static_cast<double>(bench.events().size());
  result.rate_hz = count / bench.pixel_count() / seconds;
  for (const PixelEvent& event : bench.events()) result.on_share += event.polarity / count;
  for (const auto& events : bench.events_by_pixel()) {
    for (std::size_t i = 1; i < events.size(); ++i) {
      result.intervals_s.push_back(static_cast<double>(events[i].t_us - events[i - 1].t_us) * 1e-6);
    }
  }
  std::sort(result.intervals_s.begin(), result.intervals_s.end());
  return result;
}

std::vector<double> refractory_intervals(const SensorBench::Set& set) {
  constexpr std::int64_t kHalfCycle_us = 2000;
  constexpr double kJump = 5;
  SensorBench bench(set.without_queue());
  for (int i = 0; i < 10; ++i) bench.jump(i % 2 == 0 ? kJump : 0, kHalfCycle_us);
  std::vector<double> intervals_us;
  for (const auto& events : bench.events_by_pixel()) {
    for (std::size_t i = 1; i < events.size(); ++i) {
      intervals_us.push_back(static_cast<double>(events[i].t_us - events[i - 1].t_us));
    }
  }
  std::sort(intervals_us.begin(), intervals_us.end());
  return intervals_us;
}

Saturation saturation(SensorBench::Set set) {
  set.sensor.hot_pixel_fraction = 0;
  set.sensor.refractory_us = 0;
  set.light.illuminance_lux = LightParams::kReference_lux;
  const double limit_mev_s = set.sensor.readout_mev_s = 1;
  const double pixels = set.size.width * set.size.height;
  Saturation result{{"leaves the sensor", {}}, {"lost", {}}, {"left", {}}};
  for (const double share : {0.1, 0.3, 0.6, 0.9, 1.2, 1.8, 2.6, 3.5, 5.0}) {
    constexpr double kSeconds = 0.05;
    set.sensor.noise_hz = share * limit_mev_s * 1e6 / pixels;
    SensorBench bench(set);
    bench.wait(static_cast<std::int64_t>(kSeconds * 1e6));
    const double out = static_cast<double>(bench.events().size());
    const double lost = static_cast<double>(bench.lost());
    result.output_mev_s.points.push_back({share * limit_mev_s, out / kSeconds * 1e-6});
    result.lost_share.points.push_back({share * limit_mev_s, lost / (lost + out)});
  }
  set.sensor.noise_hz = 0;
  set.sensor.jitter_us = 0;
  set.sensor.threshold_mismatch = 0;
  SensorBench bench(set);
  bench.jump(1.5 * set.sensor.threshold, 20'000);
  const auto& events = bench.events();
  for (std::size_t i = 0; i < events.size(); ++i) {
    result.burst.points.push_back({static_cast<double>(events[i].t_us - events.front().t_us),
                                   static_cast<double>(i + 1) / pixels});
  }
  return result;
}

Conservation conservation(const SensorBench::Set& set) {
  constexpr double kSeconds = 0.4;
  constexpr std::int64_t kStep_us = 1000;
  const double threshold = set.sensor.threshold;
  SensorBench bench(set.without_queue());
  const auto light_at = [](double t_us) {
    const double turn = 2 * std::numbers::pi;
    const double t_s = t_us * 1e-6;
    return 1.2 * std::sin(turn * 7 * t_s) + 0.8 * std::sin(turn * 17 * t_s);
  };
  bench.follow(light_at, static_cast<std::int64_t>(kSeconds * 1e6));
  bench.wait(50'000);
  const double at_rest = light_at(kSeconds * 1e6);

  Conservation result;
  result.light.name = "ln(light)";
  result.sum.name = "mean of signed events × threshold";
  const double per_event = threshold / bench.pixel_count();
  double sum = 0;
  std::size_t next = 0;
  const auto& events = bench.events();
  for (std::int64_t t_us = 0; t_us <= static_cast<std::int64_t>(kSeconds * 1e6); t_us += kStep_us) {
    for (; next < events.size() && events[next].t_us <= t_us; ++next) {
      sum += events[next].polarity ? per_event : -per_event;
    }
    const double t_s = static_cast<double>(t_us) * 1e-6;
    result.light.points.push_back({t_s, light_at(static_cast<double>(t_us))});
    result.sum.points.push_back({t_s, sum});
  }
  for (const auto& pixel : bench.events_by_pixel()) {
    double total = 0;
    for (const PixelEvent& event : pixel) total += event.polarity ? 1 : -1;
    result.differences.push_back(total - at_rest / threshold);
  }
  std::sort(result.differences.begin(), result.differences.end());
  return result;
}

}  // namespace puck
