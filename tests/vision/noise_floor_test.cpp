#include "common/vision/scene/noise_floor.h"

#include <doctest/doctest.h>

#include "tests/vision/random_numbers.h"

namespace puck {
namespace {

constexpr SensorSize kNoisySensor{320, 240};

// A sensor all of whose pixels fire at random.
class Noisy {
 public:
  // For so long, with so many events a millisecond.
  void run(int milliseconds, int events_a_ms) {
    for (int i = 0; i < milliseconds; ++i) {
      for (int n = 0; n < events_a_ms; ++n) {
        const auto x = static_cast<int>(random_.below(320));
        floor.take(x, static_cast<int>(random_.below(240)));
      }
      for (int column = 0; column < busy_columns; ++column) {
        for (int y = 0; y < 240; ++y) floor.take(column, y);
      }
      time_us_ += 1'000;
      floor.decide(time_us_);
    }
  }
  void wait(std::int64_t duration_us) { time_us_ += duration_us; }
  std::int64_t quiet_us() const { return floor.quiet_us(); }
  double hz() const { return floor.per_pixel_us() * 1e6; }

  NoiseFloor floor{kNoisySensor};
  int busy_columns = 0;  // from the left, of pixels that fire each millisecond besides

 private:
  std::int64_t time_us_ = 0;
  test::RandomNumbers random_;
};

// 1.3 Hz of 320 × 240 pixels.
constexpr int kEvents_a_ms = 100;
constexpr double kHz = 100e3 / (320 * 240);

TEST_CASE("The noise of a sensor is known after 60 ms, and before that it is none") {
  Noisy sensor;
  sensor.run(55, kEvents_a_ms);
  CHECK(sensor.hz() == 0);
  sensor.run(10, kEvents_a_ms);
  CHECK(sensor.hz() == doctest::Approx(kHz).epsilon(0.2));
  sensor.run(1'000, kEvents_a_ms);
  CHECK(sensor.hz() == doctest::Approx(kHz).epsilon(0.15));
}

TEST_CASE("Noise alone is quiet, and what moves in a small part of the image is not") {
  Noisy sensor;
  sensor.run(2'000, kEvents_a_ms);
  CHECK(sensor.quiet_us() > 1'000'000);
  sensor.busy_columns = 1;
  sensor.run(20, kEvents_a_ms);
  CHECK(sensor.quiet_us() < 1'000);
}

TEST_CASE("What moves in most of the image is no noise") {
  Noisy sensor;
  sensor.busy_columns = 230;
  sensor.run(500, kEvents_a_ms);
  CHECK(sensor.hz() == doctest::Approx(kHz).epsilon(0.2));
}

TEST_CASE("More noise is believed in half a second, less in a tenth") {
  Noisy sensor;
  sensor.run(100, kEvents_a_ms);
  sensor.run(200, 4 * kEvents_a_ms);
  CHECK(sensor.hz() < 3 * kHz);
  sensor.run(1'500, 4 * kEvents_a_ms);
  CHECK(sensor.hz() > 3.4 * kHz);
  sensor.run(200, kEvents_a_ms);
  CHECK(sensor.hz() < 1.3 * kHz);
}

TEST_CASE(
    "A sensor that has run for long, or whose packets fail to come for a while, is no quieter") {
  for (const std::int64_t gap_us : {200'000LL, 60'000'000LL}) {
    CAPTURE(gap_us);
    Noisy started;
    started.wait(gap_us);
    started.run(70, kEvents_a_ms);
    CHECK(started.hz() == doctest::Approx(kHz).epsilon(0.2));
    Noisy interrupted;
    interrupted.run(500, kEvents_a_ms);
    interrupted.wait(gap_us);
    interrupted.run(70, kEvents_a_ms);
    CHECK(interrupted.hz() == doctest::Approx(kHz).epsilon(0.2));
  }
}

}  // namespace
}  // namespace puck
