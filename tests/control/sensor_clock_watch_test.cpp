#include "common/control/sensor_clock_watch.h"

#include <cstdint>

#include <doctest/doctest.h>

#include "tests/control/arm_bench.h"

namespace puck {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;

// A watch and a camera with a simulated time and an estimate each millisecond.
struct Bench {
  void run(std::int64_t ms, double rate = 1, bool has_events = true) {
    for (std::int64_t i = 0; i < ms; ++i) {
      now_us += 1000;
      sensor_us += 1000 * rate;
      watch.see(static_cast<std::int64_t>(sensor_us), now_us, has_events);
      if (!watch.is_believed(now_us)) ++doubted_ms;
    }
  }

  std::int64_t now_us = 5'000'000;
  double sensor_us = 777;
  SensorClockWatch watch;
  std::int64_t doubted_ms = 0;
};

TEST_CASE("A camera's clock with 200 ppm drift is accepted for two hours") {
  for (const double rate : {1.0002, 0.9998}) {
    Bench bench;
    bench.run(7'200'000, rate);
    CHECK(bench.doubted_ms == 0);
    CHECK(bench.watch.disagreements() == 0);
  }
}

TEST_CASE("A jump of the sensor's time, in either direction, is distrusted for a second") {
  for (const std::int64_t jump_us : {-kSecondUs, std::int64_t{-2000}, 300'000L, 1000 * kSecondUs}) {
    CAPTURE(jump_us);
    Bench bench;
    bench.run(2000);
    bench.sensor_us += static_cast<double>(jump_us);
    bench.run(3000);
    CHECK(bench.doubted_ms == 1000);
    CHECK(bench.watch.disagreements() == 1);
  }
}

TEST_CASE("A sensor's time at another rate is distrusted permanently") {
  for (const double rate : {0.0, 0.5, 0.95, 1.05, 2.0, 1000.0}) {
    CAPTURE(rate);
    Bench bench;
    bench.run(60'000, rate);
    bench.doubted_ms = 0;
    bench.run(60'000, rate);
    CHECK(bench.doubted_ms == 60'000);
  }
}

TEST_CASE("One delay of estimates with a later catch-up costs a single second") {
  for (const std::int64_t held_up_ms : {250, 500, 1000}) {
    for (const std::int64_t times_as_fast : {2, 5, 20}) {
      CAPTURE(held_up_ms);
      CAPTURE(times_as_fast);
      Bench bench;
      bench.run(2000);
      bench.now_us += 1000 * held_up_ms;
      const std::int64_t catching_up_ms = held_up_ms / (times_as_fast - 1);
      bench.run(catching_up_ms, static_cast<double>(times_as_fast));
      bench.run(5000);
      CHECK(bench.doubted_ms <= 1000 + catching_up_ms);
      CHECK(bench.watch.disagreements() == 1);
    }
  }
}

TEST_CASE("Sensor time may stand still while no puck moves, and then catch up") {
  Bench bench;
  bench.run(1000);
  bench.run(10'000, 0, false);
  bench.sensor_us += 10'000 * 1000;
  bench.run(1000);
  CHECK(bench.doubted_ms == 0);
  // Even from the beginning.
  Bench other;
  other.run(10'000, 0, false);
  other.sensor_us += 10'000 * 1000;
  other.run(1000);
  CHECK(other.doubted_ms == 0);
}

TEST_CASE("The arm stops while the sensor's time is invalid, and plays again afterwards") {
  ArmBench bench;
  std::int64_t ahead_us = 0;
  std::int64_t events_session = 1;
  const auto play = [&](int ms, double rate, bool restarts) {
    for (int i = 0; i < ms; ++i) {
      ahead_us += static_cast<std::int64_t>(1000 * (rate - 1));
      if (restarts) ++events_session;
      PublishedEstimate estimate = bench.estimate();
      estimate.newest_event.us += ahead_us;
      estimate.events_session = events_session;
      bench.arm.hear(estimate, bench.now, bench.sender);
      bench.arm.hear(bench.command(i % 400 < 200 ? 0.2 : -0.2), bench.now, bench.sender);
      bench.run(1);
    }
  };
  const auto is_still = [&] {
    return bench.stands() && bench.arm.state().reason == "no live track";
  };
  play(500, 1, false);
  CHECK(!bench.stands());
  CHECK(bench.arm.sensor_clock_disagreements() == 0);

  ahead_us -= kSecondUs / 2;
  play(300, 1, false);
  CHECK(is_still());
  CHECK(bench.arm.sensor_clock_disagreements() == 1);
  play(1000, 1, false);
  CHECK(!bench.stands());

  play(1000, 3, false);
  CHECK(is_still());
  play(20'000, 1, false);
  CHECK(!bench.stands());

  // A camera that restarts with every estimate.
  play(300, 1, true);
  CHECK(is_still());
  play(300, 1, false);
  CHECK(!bench.stands());
}

TEST_CASE("A simulated camera with announced slips is followed; a real one does not slip") {
  for (const bool is_real : {false, true}) {
    CAPTURE(is_real);
    ArmControllerParams params;
    params.track.camera_is_real = is_real;
    ArmBench bench(params);
    std::int64_t behind_us = 0;
    for (int i = 0; i < 3000; ++i) {
      behind_us += 500;  // half as fast as real time
      PublishedEstimate estimate = bench.estimate();
      estimate.newest_event.us -= behind_us;
      bench.arm.hear(estimate, bench.now, bench.sender);
      bench.arm.hear(bench.command(i % 400 < 200 ? 0.2 : -0.2), bench.now, bench.sender);
      bench.run(1);
    }
    CHECK((bench.arm.state().reason == "no live track") == is_real);
    CHECK((bench.arm.sensor_clock_disagreements() > 0) == is_real);
  }
}

TEST_CASE("A real arm follows no camera whose time has no zero on the host's clock") {
  for (const bool needs_it : {false, true}) {
    ArmControllerParams params;
    params.track.camera_is_real = needs_it;
    ArmBench bench(params);
    for (int i = 0; i < 300; ++i) {
      PublishedEstimate estimate = bench.estimate();
      estimate.event_utime.reset();
      bench.arm.hear(estimate, bench.now, bench.sender);
      bench.arm.hear(bench.command(0.1), bench.now, bench.sender);
      bench.run(1);
    }
    CHECK((bench.arm.state().reason == "no live track") == needs_it);
  }
}

}  // namespace
}  // namespace puck
