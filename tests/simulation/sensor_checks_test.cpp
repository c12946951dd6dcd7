#include "tools/simulate/sensor_checks.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <doctest/doctest.h>

namespace puck {
namespace {

double at_share(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

double at_x(const Curve& curve, double x) {
  for (const Curve::Point& point : curve.points) {
    if (std::abs(point.x - x) < 1e-6) return point.y;
  }
  FAIL("no point at ", x);
  return 0;
}

SensorBench::Set in_light(double lux) {
  SensorBench::Set set;
  set.light.illuminance_lux = lux;
  return set;
}

}  // namespace

TEST_CASE("A step's events spread over the pixels according to threshold, mismatch and start") {
  for (const double ratio : {std::log(2.0), std::log(5.0), -std::log(3.0)}) {
    const StepResponse response = step_response({}, ratio);
    double worst = 0;
    double mean = 0;
    for (std::size_t i = 0; i < response.measured.points.size(); ++i) {
      worst =
          std::max(worst, std::abs(response.measured.points[i].y - response.expected.points[i].y));
      mean += static_cast<double>(i) * response.measured.points[i].y;
    }
    CAPTURE(ratio);
    // 3,072 pixels: a standard deviation of a share is at most 0.009.
    CHECK(worst < 0.03);
    // Pixels start anywhere between two events, and a low threshold adds more than a high one
    // takes.
    CHECK(mean == doctest::Approx(std::abs(ratio) / 0.2 * (1 + 0.15 * 0.15) - 0.5).epsilon(0.03));
  }
}

TEST_CASE("A sinusoid's rate is zero below the threshold and grows by 2 events a threshold") {
  SensorBench::Set set;
  set.size = {32, 24};
  const Curve curve = contrast_response(set);
  CHECK(at_x(curve, 0.1) < 0.001);
  // 4 sigma below the threshold no pixel fires steadily; far above, contrast is what counts.
  CHECK(at_x(curve, 2.0) - at_x(curve, 1.0) == doctest::Approx(2 * 1.0 / 0.2).epsilon(0.05));
  CHECK(at_x(curve, 1.0) > 8);
  CHECK(at_x(curve, 1.0) < 10);
}

TEST_CASE("A fast sinusoid's rate falls as a first-order low-pass whose corner scales with light") {
  for (const double lux : {100.0, 300.0, 1000.0}) {
    CAPTURE(lux);
    SensorBench::Set set = in_light(lux);
    set.size = {24, 16};
    const FrequencyResponse response = frequency_response(set);
    CHECK(response.corner_hz == doctest::Approx(500 * lux / 300).epsilon(0.08));
    for (std::size_t i = 0; i < response.measured.points.size(); ++i) {
      CHECK(std::abs(response.measured.points[i].y - response.expected.points[i].y) < 0.05);
    }
  }
}

TEST_CASE("Events are 0.1 ms late in bright light and milliseconds in dim, with more jitter") {
  double median_before_us = 0;
  double spread_before_us = 0;
  for (const double lux : {1000.0, 300.0, 100.0, 30.0}) {
    CAPTURE(lux);
    const Latency found = latency(in_light(lux));
    REQUIRE(found.delays_us.size() == 3072);
    const double median_us = at_share(found.delays_us, 0.5);
    const double spread_us = at_share(found.delays_us, 0.9) - at_share(found.delays_us, 0.1);
    CHECK(median_us == doctest::Approx(found.expected_median_us).epsilon(0.05));
    CHECK(median_us > 1.5 * median_before_us);
    CHECK(spread_us > 1.5 * spread_before_us);
    median_before_us = median_us;
    spread_before_us = spread_us;
  }
  CHECK(at_share(latency(in_light(1000)).delays_us, 0.5) < 200);
  CHECK(median_before_us > 1000);
}

TEST_CASE("Noise is a Poisson process, ON as often as OFF, and stronger in dim light") {
  for (const double lux : {30.0, 300.0, 3000.0}) {
    CAPTURE(lux);
    SensorBench::Set set = in_light(lux);
    set.sensor.noise_hz = 5;
    set.sensor.hot_pixel_fraction = 0;
    const Noise found = noise(set, 1);
    const double expected_hz = 5 * std::sqrt(300 / lux);
    CHECK(found.rate_hz == doctest::Approx(expected_hz).epsilon(0.05));
    CHECK(found.on_share == doctest::Approx(0.5).epsilon(0.05));
  }
  SensorBench::Set set;
  set.sensor.noise_hz = 50;
  set.sensor.hot_pixel_fraction = 0;
  const Noise found = noise(set, 1);
  // Of an exponential distribution: the median is ln 2 of the mean, cut a little by the end.
  CHECK(at_share(found.intervals_s, 0.5) == doctest::Approx(std::log(2.0) / 50).epsilon(0.06));
  CHECK(at_share(found.intervals_s, 0.9) == doctest::Approx(std::log(10.0) / 50).epsilon(0.06));
}

TEST_CASE("Hot pixels have the specified number and rate") {
  SensorBench::Set set;
  set.sensor.noise_hz = 0;
  set.sensor.hot_pixel_fraction = 0.005;
  set.sensor.hot_pixel_hz = 800;
  SensorBench bench(set);
  bench.wait(1'000'000);
  int hot = 0;
  for (const auto& events : bench.events_by_pixel()) {
    if (events.empty()) continue;
    ++hot;
    // Two of a hundred may fall on the same pixel; else 800, minus the refractory period's share.
    CHECK(events.size() > 600);
  }
  CHECK(hot >= 13);
  CHECK(hot <= 15);
}

TEST_CASE("The S-curve returns threshold and mismatch") {
  const std::vector<double> found = thresholds({});
  REQUIRE(found.size() > 3000);
  CHECK(at_share(found, 0.5) == doctest::Approx(0.2).epsilon(0.02));
  const double sigma = (at_share(found, 0.8413) - at_share(found, 0.1587)) / 2;
  CHECK(sigma == doctest::Approx(0.03).epsilon(0.08));
}

TEST_CASE("Events of a pixel keep the refractory period, and many are just beyond it") {
  for (const double refractory_us : {50.0, 300.0}) {
    SensorBench::Set set;
    set.sensor.refractory_us = refractory_us;
    const std::vector<double> intervals_us = refractory_intervals(set);
    REQUIRE(intervals_us.size() > 10'000);
    // Times are cut to whole µs.
    CHECK(intervals_us.front() >= refractory_us - 1);
    CHECK(at_share(intervals_us, 0.1) < refractory_us + 2 * set.sensor.jitter_us);
  }
}

TEST_CASE(
    "The readout passes events up to its rate; the rest waits by rows, with waiting pixels mute") {
  const Saturation found = saturation({});
  for (const Curve::Point& point : found.output_mev_s.points) {
    CAPTURE(point.x);
    if (point.x < 0.95) {
      CHECK(point.y == doctest::Approx(point.x).epsilon(0.03));
      CHECK(at_x(found.lost_share, point.x) < 0.001);
    } else {
      CHECK(point.y == doctest::Approx(1).epsilon(0.02));
    }
  }
  CHECK(at_x(found.lost_share, 5.0) > 0.7);
  // 3,072 events at 1 Mev/s, row by row of 64.
  REQUIRE(found.burst.points.size() == 3072);
  CHECK(found.burst.points.back().x == doctest::Approx(3072).epsilon(0.03));
  std::map<double, int> at_once;
  for (const Curve::Point& point : found.burst.points) ++at_once[point.x];
  CHECK(at_once.size() == 48);
  for (const auto& [t_us, count] : at_once) CHECK(count == 64);
}

TEST_CASE("Signed events add up to the change of the light") {
  SensorBench::Set set;
  const Conservation usual = conservation(set);
  CHECK(std::abs(at_share(usual.differences, 0.5)) < 1);
  double worst = 0;
  for (std::size_t i = 0; i < usual.light.points.size(); ++i) {
    worst = std::max(worst, std::abs(usual.light.points[i].y - usual.sum.points[i].y));
  }
  // One threshold, and the change of light in the photoreceptor's 0.3 ms, at up to 140 a second.
  CHECK(worst < 0.2 + 0.05);
  // Without mismatch no pixel drifts, during all pauses.
  set.sensor.threshold_mismatch = 0;
  set.sensor.refractory_us = 500;
  const Conservation exact = conservation(set);
  CHECK(exact.differences.front() >= -1);
  CHECK(exact.differences.back() <= 1);
}

}  // namespace puck
