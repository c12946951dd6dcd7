// A camera that sends far more than the tracker can process.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>

#include <doctest/doctest.h>

#include "tests/support/crowd_publisher.h"
#include "tests/support/process_usage.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kFlood{3};
constexpr double kMostGrowthMb = 100;

}  // namespace

TEST_CASE("the tracker keeps publishing in a flood with bounded memory, and recovers at once") {
  const std::string url = new_lcm_url();
  BusListener bus(url);
  // Wide windows make every event cost more, so that this machine can send several times as many as
  // it can process.
  ChildProcess tracker =
      start_service("puck-tracker", url, {"tracker.preset=correlation", "tracker.half_width_px=8"});
  REQUIRE(bus.hears({"puck-tracker"}));
  CrowdPublisher camera(url);
  const auto answers_the_newest = [&](std::chrono::milliseconds timeout) {
    const std::int64_t newest_us = camera.publish(200);
    return poll_until([&] { return bus.newest_event_us() >= newest_us; },
                      [&] {
                        camera.publish(200);
                        bus.until([] { return false; }, std::chrono::milliseconds(5));
                      },
                      timeout);
  };
  REQUIRE(answers_the_newest(std::chrono::seconds(20)));

  const double calm_mb = resident_mb(tracker.pid());
  const std::int64_t estimates = bus.fresh_estimates();
  double most_mb = calm_mb;
  {
    const std::jthread flood([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) camera.publish(15'000);
    });
    const auto end = Clock::now() + kFlood;
    bus.until(
        [&] {
          most_mb = std::max(most_mb, resident_mb(tracker.pid()));
          return Clock::now() >= end;
        },
        2 * kFlood);
  }
  CHECK(bus.fresh_estimates() - estimates > 10);
  CHECK(most_mb - calm_mb < kMostGrowthMb);

  // With a queue of all excess events it would be busy for several times as long.
  CHECK(answers_the_newest(kFlood));
  CHECK(bus.until([&] {
    return bus.counter("puck-tracker", "events_skipped") +
               bus.counter("puck-tracker", "events_lost") >
           0;
  }));
  tracker.send(SIGTERM);
  CHECK(tracker.wait_for(std::chrono::seconds(10)) == 0);
}

}  // namespace puck
