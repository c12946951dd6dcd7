#include "common/simulation/flicker.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include "tools/simulate/sensor_bench.h"

namespace puck {

TEST_CASE("A flickering lamp adds its filtered ln to every response") {
  // 500 Hz of cutoff leave 100 Hz nearly as it is, 5 Hz take a twentieth.
  for (const double cutoff_hz : {500.0, 5.0}) {
    const Flicker flicker(0.2, 100, cutoff_hz);
    float lowest = 0;
    float highest = 0;
    double mean = 0;
    for (int t_us = 0; t_us < 10'000; ++t_us) {
      const float response = flicker.response_at(t_us);
      CHECK(response == doctest::Approx(flicker.response_at(t_us + 30'000.0)).epsilon(0.001));
      lowest = std::min(lowest, response);
      highest = std::max(highest, response);
      mean += response / 10'000;
    }
    const double share = 1 / std::sqrt(1 + std::pow(100 / cutoff_hz, 2));
    CHECK(highest - lowest == doctest::Approx(share * std::log(1.2 / 0.8)).epsilon(0.02));
    // The mean of ln(1 + m sin) is ln((1 + sqrt(1 - m^2)) / 2).
    CHECK(mean == doctest::Approx(std::log((1 + std::sqrt(0.96)) / 2)).epsilon(0.02));
  }
}

TEST_CASE("Strong flicker makes all pixels fire in step, weak flicker none") {
  SensorBench::Set set;
  set.sensor.noise_hz = 0;
  set.sensor.hot_pixel_fraction = 0;
  set.sensor.threshold_mismatch = 0;
  set.light.flicker_modulation = 0.08;
  SensorBench weak(set);
  weak.wait(100'000);
  CHECK(weak.events().empty());

  // ln(1.3 / 0.7) = 0.62, a little less behind the low-pass: at least twice up and twice down.
  set.light.flicker_modulation = 0.3;
  SensorBench strong(set);
  strong.wait(110'000);
  std::map<std::int64_t, int> on_by_ms;
  int on = 0;
  for (const PixelEvent& event : strong.events()) {
    if (event.t_us < 10'000 || !event.polarity) continue;
    ++on;
    ++on_by_ms[event.t_us / 1000 % 10];
  }
  CHECK(on >= 2 * 10 * strong.pixel_count());
  CHECK(on <= 3 * 10 * strong.pixel_count());
  // The light grows for half of each 10 ms: no ON events in the other half.
  CHECK(on_by_ms.size() <= 6);
}

TEST_CASE("Flicker and motion add up: a pixel's events follow the sum of both") {
  SensorBench::Set set;
  set.sensor.noise_hz = 0;
  set.sensor.hot_pixel_fraction = 0;
  set.sensor.threshold_mismatch = 0;
  set.sensor.readout_mev_s = 1e6;
  set.light.flicker_modulation = 0.2;
  SensorBench bench(set);
  bench.follow([](double t_us) { return 3e-5 * t_us; }, 100'000);
  bench.wait(20'000);
  for (const auto& events : bench.events_by_pixel()) {
    double sum = 0;
    for (const PixelEvent& event : events) sum += event.polarity ? 0.2 : -0.2;
    // 3 in all, and the flicker within its swing.
    CHECK(std::abs(sum - 3) < 0.2 + 0.21);
    CHECK(events.size() > 15);
  }
}

}  // namespace puck
