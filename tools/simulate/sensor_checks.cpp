#include "tools/simulate/sensor_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

SensorBench::Set without_noise(SensorBench::Set set) {
  set.sensor.noise_hz = 0;
  set.sensor.hot_pixel_fraction = 0;
  return set;
}

// All pixels fire at once on the bench, which no readout is made for.
SensorBench::Set without_queue(SensorBench::Set set) {
  set = without_noise(set);
  set.sensor.readout_mev_s = 1e6;
  return set;
}

// Only the photoreceptor and the threshold are to be seen.
SensorBench::Set without_pauses(SensorBench::Set set) {
  set = without_queue(set);
  set.sensor.refractory_us = 0;
  set.sensor.jitter_us = 0;
  return set;
}

double cutoff_hz(const SensorBench::Set& set) {
  return set.sensor.cutoff_hz * set.light.illuminance_lux / LightParams::kReference_lux;
}

double time_constant_us(const SensorBench::Set& set) { return 1e6 / (kTurn * cutoff_hz(set)); }

// Calls with every combination of two thresholds and a start between two events, and its weight.
template <typename Use>
void for_each_pixel_kind(const EventSensorParams& sensor, Use use) {
  constexpr int kThresholds = 24;  // To both sides, up to 4 standard deviations.
  constexpr int kStarts = 50;
  const auto weight = [](int i) { return std::exp(-0.5 * std::pow(4.0 * i / kThresholds, 2)); };
  double all = 0;
  for (int i = -kThresholds; i <= kThresholds; ++i) all += weight(i);
  for (int on = -kThresholds; on <= kThresholds; ++on) {
    for (int off = -kThresholds; off <= kThresholds; ++off) {
      const double sigma = 4.0 / kThresholds * sensor.threshold_mismatch;
      const double share = weight(on) * weight(off) / (all * all * kStarts);
      for (int start = 0; start < kStarts; ++start) {
        const double from = sensor.threshold_mismatch > 0 ? (start + 0.5) / kStarts - 0.5 : 0;
        use(sensor.threshold + on * sigma, sensor.threshold + off * sigma, from, share);
      }
    }
  }
}

double events_per_cycle(const SensorBench::Set& set, double swing, double frequency_hz) {
  constexpr double kSettleCycles = 2;
  constexpr double kCycles = 4;
  constexpr double kStepsPerCycle = 60;
  SensorBench bench(without_pauses(set));
  const auto light_at = [&](double t_us) {
    return swing / 2 * std::sin(kTurn * frequency_hz * t_us * 1e-6);
  };
  const double cycle_us = 1e6 / frequency_hz;
  const auto step_us = std::max<std::int64_t>(1, std::lround(cycle_us / kStepsPerCycle));
  bench.follow(light_at, std::lround(kSettleCycles * cycle_us), step_us);
  bench.forget_events();
  const std::int64_t counted_us = std::lround(kCycles * cycle_us);
  bench.follow(light_at, counted_us, step_us);
  const double cycles = static_cast<double>(counted_us) / cycle_us;
  return static_cast<double>(bench.events().size()) / bench.pixel_count() / cycles;
}

}  // namespace

StepResponse step_response(const SensorBench::Set& set, double log_ratio) {
  SensorBench bench(without_noise(set));
  bench.jump(log_ratio, 100'000);
  StepResponse response;
  response.measured.name = "measured";
  response.expected.name = "floor(|ln ratio| / threshold)";
  std::vector<double> measured;
  std::vector<double> expected;
  const auto add = [](std::vector<double>& shares, std::size_t count, double share) {
    if (shares.size() <= count) shares.resize(count + 1);
    shares[count] += share;
  };
  for (const auto& events : bench.events_by_pixel()) {
    add(measured, events.size(), 1.0 / bench.pixel_count());
  }
  for_each_pixel_kind(set.sensor, [&](double on, double off, double from, double share) {
    const double start = from * std::min(on, off);
    const double count = log_ratio > 0 ? (log_ratio - start) / on : (start - log_ratio) / off;
    add(expected, static_cast<std::size_t>(std::max(0.0, std::floor(count))), share);
  });
  const std::size_t most = std::max(measured.size(), expected.size());
  measured.resize(most);
  expected.resize(most);
  for (std::size_t i = 0; i < most; ++i) {
    response.measured.points.push_back({static_cast<double>(i), measured[i]});
    response.expected.points.push_back({static_cast<double>(i), expected[i]});
  }
  return response;
}

Curve contrast_response(const SensorBench::Set& set) {
  Curve curve{"events per cycle", {}};
  for (double swing = 0; swing <= 2.01; swing += 0.1) {
    curve.points.push_back({swing, events_per_cycle(set, swing, cutoff_hz(set) / 20)});
  }
  return curve;
}

FrequencyResponse frequency_response(const SensorBench::Set& set) {
  // So many events that counting them by whole ones does not matter much.
  const double swing = 20 * set.sensor.threshold;
  const double cutoff = cutoff_hz(set);
  const double most = events_per_cycle(set, swing, cutoff / 30);
  FrequencyResponse response;
  response.measured.name = "measured";
  response.expected.name = "first-order low-pass";
  for (double ratio = 0.1; ratio < 6; ratio *= 1.3) {
    const double share = events_per_cycle(set, swing, ratio * cutoff) / most;
    const double corner_share = std::numbers::sqrt2 / 2;
    if (!response.measured.points.empty() && share < corner_share && response.corner_hz == 0) {
      const Curve::Point before = response.measured.points.back();
      const double way = (before.y - corner_share) / (before.y - share);
      response.corner_hz = before.x + way * (ratio * cutoff - before.x);
    }
    response.measured.points.push_back({ratio * cutoff, share});
    response.expected.points.push_back({ratio * cutoff, 1 / std::sqrt(1 + ratio * ratio)});
  }
  return response;
}

Latency latency(SensorBench::Set set) {
  constexpr double kThresholds = 1.5;
  set = without_queue(set);
  set.sensor.threshold_mismatch = 0;
  const double slowest_us = 10 * time_constant_us(set) + 4 * set.sensor.jitter_us;
  SensorBench bench(set);
  const double step = kThresholds * set.sensor.threshold;
  bench.follow([&](double) { return step; }, 1, 1);
  bench.follow([&](double) { return step; }, static_cast<std::int64_t>(slowest_us) + 1000, 20);
  Latency result;
  for (const auto& events : bench.events_by_pixel()) {
    if (!events.empty()) result.delays_us.push_back(static_cast<double>(events.front().t_us));
  }
  std::sort(result.delays_us.begin(), result.delays_us.end());
  const double brighter = set.light.illuminance_lux / LightParams::kReference_lux;
  result.expected_median_us = time_constant_us(set) * std::log(kThresholds / (kThresholds - 1)) +
                              set.sensor.jitter_us / std::sqrt(brighter);
  return result;
}

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

std::vector<double> thresholds(SensorBench::Set set) {
  // So slow that the low-pass lags by the same everywhere.
  constexpr double kSlope_1_us = 2e-5;
  constexpr std::int64_t kDuration_us = 80'000;
  SensorBench bench(without_pauses(set));
  bench.follow([](double t_us) { return kSlope_1_us * t_us; }, kDuration_us);
  std::vector<double> found;
  for (const auto& events : bench.events_by_pixel()) {
    if (events.size() < 3) continue;
    // The first may have come while the low-pass still fell behind.
    const auto span_us = static_cast<double>(events.back().t_us - events[1].t_us);
    found.push_back(kSlope_1_us * span_us / static_cast<double>(events.size() - 2));
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<double> refractory_intervals(const SensorBench::Set& set) {
  constexpr std::int64_t kHalfCycle_us = 2000;
  constexpr double kJump = 5;
  SensorBench bench(without_queue(set));
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
  SensorBench bench(without_queue(set));
  const auto light_at = [](double t_us) {
    const double t_s = t_us * 1e-6;
    return 1.2 * std::sin(kTurn * 7 * t_s) + 0.8 * std::sin(kTurn * 17 * t_s);
  };
  bench.follow(light_at, static_cast<std::int64_t>(kSeconds * 1e6));
  bench.wait(50'000);
  const double at_rest = light_at(kSeconds * 1e6);

  Conservation result;
  result.light.name = "ln(light)";
  result.sum.name = "signed events x threshold, mean";
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
