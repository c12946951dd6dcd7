#include "tools/simulate/sensor_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double cutoff_hz(const SensorBench::Set& set) { return 1e6 / (kTurn * set.time_constant_us()); }

// Calls with all combinations of two thresholds and a start between two events, and their weight.
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
  SensorBench bench(set.without_pauses());
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
  SensorBench bench(set.without_noise());
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
  // Enough events for a small quantisation error.
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
  set = set.without_queue();
  set.sensor.threshold_mismatch = 0;
  const double slowest_us = 10 * set.time_constant_us() + 4 * set.sensor.jitter_us;
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
  result.expected_median_us = set.time_constant_us() * std::log(kThresholds / (kThresholds - 1)) +
                              set.sensor.jitter_us / std::sqrt(brighter);
  return result;
}

std::vector<double> thresholds(SensorBench::Set set) {
  // Slow enough for a constant lag of the low-pass.
  constexpr double kSlope_1_us = 2e-5;
  constexpr std::int64_t kDuration_us = 80'000;
  SensorBench bench(set.without_pauses());
  bench.follow([](double t_us) { return kSlope_1_us * t_us; }, kDuration_us);
  std::vector<double> found;
  for (const auto& events : bench.events_by_pixel()) {
    if (events.size() < 3) continue;
    // Without the first interval, in which the low-pass may still settle.
    const auto span_us = static_cast<double>(events.back().t_us - events[1].t_us);
    found.push_back(kSlope_1_us * span_us / static_cast<double>(events.size() - 2));
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace puck
