#include "common/calibration/hot_pixels.h"

#include <algorithm>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "common/simulation/event_sensor.h"
#include "common/simulation/simulated_table.h"

namespace puck {
namespace {

constexpr SensorSize kTinySensor{64, 48};

// Events in any order, returned in the order of their times.
class Recording {
 public:
  void add(double t_us, int x, int y) { events_.push_back({t_us, {x, y}}); }
  // At random times with this mean rate.
  void add_noise(int x, int y, double rate_hz, double seconds) {
    std::exponential_distribution<double> gap(rate_hz);
    for (double t = gap(random_); t < seconds; t += gap(random_)) add(1e6 * t, x, y);
  }
  HotPixelReport report() {
    std::stable_sort(events_.begin(), events_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    EventPacket packet;
    for (const auto& [t_us, place] : events_) {
      Event event;
      event.x = static_cast<std::uint16_t>(place.x);
      event.y = static_cast<std::uint16_t>(place.y) & 0x7fff;
      event.offset_us = static_cast<std::uint32_t>(t_us);
      packet.events.push_back(event);
    }
    HotPixelFinder finder(kTinySensor);
    finder.add(packet);
    return finder.find();
  }

 private:
  std::vector<std::pair<double, PixelPlace>> events_;
  std::mt19937 random_{1};
};

std::vector<PixelPlace> places_of(const HotPixelReport& report) {
  std::vector<PixelPlace> places;
  for (const HotPixel& pixel : report.pixels) places.push_back(pixel.place);
  return places;
}

TEST_CASE("hot pixels are separated from noise and listed by rate, highest first") {
  Recording recording;
  for (int y = 0; y < kTinySensor.height; ++y) {
    for (int x = 0; x < kTinySensor.width; ++x) recording.add_noise(x, y, 1, 4);
  }
  recording.add_noise(0, 0, 300, 4);
  recording.add_noise(30, 20, 50, 4);
  recording.add_noise(31, 20, 100, 4);
  const HotPixelReport report = recording.report();
  CHECK(places_of(report) == std::vector<PixelPlace>{{0, 0}, {31, 20}, {30, 20}});
  CHECK(report.pixels[0].rate_hz == doctest::Approx(300).epsilon(0.1));
  CHECK(report.pixels[0].active_share > 0.99);
  CHECK(report.median_rate_hz == doctest::Approx(1).epsilon(0.3));
  CHECK(report.hot_events > 1600);
  CHECK(report.events > report.hot_events + 10'000);
}

TEST_CASE("a trembling edge and a flashing lamp are not hot pixels") {
  Recording recording;
  for (int y = 0; y < kTinySensor.height; ++y) recording.add_noise(20, y, 200, 4);
  for (int burst = 0; burst < 4; ++burst) {
    for (int i = 0; i < 100; ++i) recording.add(1e6 * burst + 500 * i, 50, 30);
  }
  recording.add(3.9e6, 1, 1);
  CHECK(recording.report().pixels.empty());
}

TEST_CASE("a pixel with few events, and less than a second of events, are no evidence") {
  Recording recording;
  recording.add_noise(10, 10, 3, 4);
  recording.add(4e6, 1, 1);
  CHECK(recording.report().pixels.empty());
  Recording brief;
  brief.add_noise(10, 10, 1000, 0.5);
  CHECK_THROWS_AS(brief.report(), std::invalid_argument);
  CHECK_THROWS_AS(HotPixelFinder(kTinySensor).find(), std::invalid_argument);
}

TEST_CASE("nearly all hot pixels of a simulated game are found, and no others") {
  SimulationParams params;
  params.seed = 7;
  params.autonomous_robot = true;
  params.sensor.hot_pixel_fraction = 2e-4;
  params.sensor.hot_pixel_hz = 100;

  // In even light and without noise nothing else fires: the same seed has the same hot pixels.
  std::set<std::pair<int, int>> truth;
  EventSensorParams dark = params.sensor;
  dark.noise_hz = 0;
  Image<float> even(params.sensor_size.width, params.sensor_size.height);
  EventSensor sensor(dark, even.view(), params.seed);
  EventPacket packet;
  sensor.finish_slice({200'000}, packet);
  for (const Event& event : packet.events) truth.insert({event.x, event.y});
  REQUIRE(truth.size() > 55);

  SimulatedTable table(params);
  HotPixelFinder finder(params.sensor_size);
  while (table.now().us < 1'500'000) {
    packet.events.clear();
    table.advance(packet);
    finder.add(packet);
  }
  std::size_t right = 0;
  const HotPixelReport report = finder.find();
  for (const PixelPlace place : places_of(report)) right += truth.count({place.x, place.y});
  CHECK(right == report.pixels.size());
  CHECK(right >= truth.size() - 2);
}

}  // namespace
}  // namespace puck
