#include "common/simulation/event_sensor.h"

#include <cmath>
#include <map>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

EventSensorParams quiet() {
  EventSensorParams params;
  params.threshold_mismatch = 0;
  params.noise_hz = 0;
  params.hot_pixel_fraction = 0;
  params.jitter_us = 0;
  return params;
}

Image<float> flat(int width, int height, float value = 0) {
  Image<float> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image(x, y) = value;
  }
  return image;
}

// Runs slices of 500 µs until all has settled.
EventPacket run_slices(EventSensor& sensor, std::int64_t first_us, int slices) {
  EventPacket all;
  for (int i = 1; i <= slices; ++i) sensor.finish_slice({first_us + 500 * i}, all);
  return all;
}

int count_of_step(double ln_ratio, double threshold) {
  EventSensorParams params = quiet();
  params.threshold = threshold;
  EventSensor sensor(params, flat(4, 4).view(), 1);
  sensor.change(2, 1, static_cast<float>(ln_ratio), {0}, {100});
  const EventPacket packet = run_slices(sensor, 0, 40);
  for (const Event& event : packet.events) {
    CHECK(event.x == 2);
    CHECK(event.y == 1);
    CHECK(event.polarity == (ln_ratio > 0 ? 1 : 0));
  }
  return static_cast<int>(packet.events.size());
}

}  // namespace

TEST_CASE("A step of the light makes floor(|ln ratio| / threshold) events") {
  CHECK(count_of_step(std::log(2.0), 0.2) == 3);
  CHECK(count_of_step(-std::log(2.0), 0.2) == 3);
  CHECK(count_of_step(std::log(10.0), 0.2) == 11);
  CHECK(count_of_step(-std::log(10.0), 0.3) == 7);
  CHECK(count_of_step(0.19, 0.2) == 0);
  CHECK(count_of_step(-0.19, 0.2) == 0);
}

TEST_CASE("The low-pass delays a small step's event by its exact exponential") {
  EventSensorParams params = quiet();
  params.cutoff_hz = 500;  // A time constant of 318.3 µs.
  params.refractory_us = 0;
  EventSensor sensor(params, flat(4, 4).view(), 1);
  sensor.change(0, 0, 0.4f, {0}, {1});
  const EventPacket packet = run_slices(sensor, 0, 4);
  REQUIRE(packet.events.size() == 1);
  // 0.4 (1 − e^(−t/τ)) = 0.2 at t = τ ln 2 = 220.6 µs, and the step lasted 1 µs.
  CHECK(std::abs(static_cast<double>(packet.newest().us) - 221) < 3);
}

TEST_CASE(
    "Where the cutoff scales with a pixel's light, darkening is reported later than brightening") {
  const auto delay_us = [](float step) {
    EventSensorParams params = quiet();
    params.cutoff_hz = 500;
    params.cutoff_luminance = 1;
    params.refractory_us = 0;
    EventSensor sensor(params, flat(4, 4).view(), 1);
    sensor.change(0, 0, step, {0}, {1});
    const EventPacket packet = run_slices(sensor, 0, 20);
    REQUIRE(packet.events.size() == 1);
    return static_cast<double>(packet.newest().us);
  };
  // tau ln(0.39 / 0.19), with tau 318.3 µs at luminance 1, inversely proportional to luminance.
  CHECK(delay_us(0.39f) ==
        doctest::Approx(318.3 / std::exp(0.39) * std::log(0.39 / 0.19)).epsilon(0.02));
  CHECK(delay_us(-0.39f) ==
        doctest::Approx(318.3 * std::exp(0.39) * std::log(0.39 / 0.19)).epsilon(0.02));
}

TEST_CASE("No pixel fires again within its refractory period, even with jitter and noise") {
  EventSensorParams params;
  params.refractory_us = 300;
  params.jitter_us = 25;
  params.noise_hz = 200;
  params.hot_pixel_fraction = 0.01;
  params.hot_pixel_hz = 5000;
  EventSensor sensor(params, flat(20, 20).view(), 3);
  EventPacket all;
  for (int i = 0; i < 200; ++i) {
    const Timestamp start{500 * i}, end{500 * (i + 1)};
    const float light = i % 8 < 4 ? 2.0f : 0.0f;
    for (int x = 0; x < 20; ++x) sensor.change(x, 7, light, start, end);
    sensor.finish_slice(end, all);
  }
  std::map<int, std::int64_t> last_us;
  std::size_t gaps = 0;
  for (const Event& event : all.events) {
    const int pixel = event.y * 20 + event.x;
    const std::int64_t now_us = all.time_of(event).us;
    if (last_us.contains(pixel)) {
      ++gaps;
      CHECK(now_us - last_us[pixel] >= 300);
    }
    last_us[pixel] = now_us;
  }
  CHECK(gaps > 2000);
}

TEST_CASE("Contrast within a refractory period is not lost") {
  EventSensorParams params = quiet();
  params.refractory_us = 2000;
  EventSensor sensor(params, flat(4, 4).view(), 1);
  sensor.change(1, 1, 1.05f, {0}, {50});
  const EventPacket packet = run_slices(sensor, 0, 40);
  REQUIRE(packet.events.size() == 5);
  CHECK(packet.newest() - packet.time_of(packet.events.front()) >= 8000);
}

TEST_CASE("Events come in the order of their times, within their slice") {
  EventSensorParams params;
  params.noise_hz = 100;
  EventSensor sensor(params, flat(40, 40).view(), 5);
  Timestamp before{0};
  std::size_t count = 0;
  for (int i = 0; i < 100; ++i) {
    const Timestamp start{500 * i}, end{500 * (i + 1)};
    for (int x = 0; x < 40; ++x) {
      sensor.change(x, 3, 0.3f * static_cast<float>((i * 7 + x) % 11), start, end);
    }
    EventPacket packet;
    sensor.finish_slice(end, packet);
    CHECK(packet.start == start);
    for (const Event& event : packet.events) {
      const Timestamp t = packet.time_of(event);
      CHECK(t >= before);
      CHECK(t >= start);
      CHECK(t < end);
      before = t;
      ++count;
    }
  }
  CHECK(count > 1000);
}

TEST_CASE("A packet with earlier events keeps its start") {
  EventSensorParams params = quiet();
  params.noise_hz = 1000;
  EventSensor sensor(params, flat(30, 30).view(), 5);
  EventPacket packet;
  sensor.finish_slice({500}, packet);
  const std::size_t first = packet.events.size();
  REQUIRE(first > 0);
  sensor.finish_slice({1000}, packet);
  REQUIRE(packet.events.size() > first);
  CHECK(packet.start == Timestamp{0});
  CHECK(packet.newest() >= Timestamp{500});
}

TEST_CASE("Noise has the specified rate") {
  EventSensorParams params = quiet();
  params.noise_hz = 2;
  EventSensor sensor(params, flat(100, 100).view(), 7);
  const EventPacket packet = run_slices(sensor, 0, 2000);
  // 2 Hz × 10,000 pixels × 1 s, give or take five standard deviations.
  CHECK(packet.events.size() > 19'300);
  CHECK(packet.events.size() < 20'700);
}

TEST_CASE("A constant picture makes no events without noise") {
  EventSensor sensor(quiet(), flat(50, 50, -1.0f).view(), 7);
  CHECK(run_slices(sensor, 0, 100).events.empty());
}

}  // namespace puck
