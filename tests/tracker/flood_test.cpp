// A tracker with more events than it can process.
#include <chrono>
#include <cstdint>
#include <random>
#include <thread>

#include <doctest/doctest.h>

#include "tests/tracker/running_tracker.h"

namespace puck {
namespace {

using namespace test;
using Clock = std::chrono::steady_clock;

// Of one packet, all at the same time.
constexpr int kEvents = 10'000;

EventPacket crowd_at(std::int64_t t_us) {
  std::mt19937 random(static_cast<unsigned>(t_us));
  EventPacket packet{{t_us}, {}};
  for (int i = 0; i < kEvents; ++i) {
    const auto x = static_cast<std::uint16_t>(random() % kSensor.width);
    const auto y = static_cast<std::uint16_t>(random() % kSensor.height);
    packet.events.push_back({x, y, 1, 0});
  }
  return packet;
}

bool answers(const RunningTracker& tracker, std::int64_t t_us) {
  return tracker.eventually([&](const auto& estimate) { return estimate.sensor_us == t_us; });
}

}  // namespace

TEST_CASE("a flooded tracker keeps to the newest events, and counts the skipped ones") {
  RunningTracker tracker;
  std::int64_t t_us = 1000;
  EventPacket crowd = crowd_at(t_us);
  tracker.publish(crowd);
  REQUIRE(answers(tracker, t_us));

  constexpr int kProbes = 50;
  const auto probe_began = Clock::now();
  for (int i = 0; i < kProbes; ++i) {
    crowd.start.us = ++t_us;
    tracker.publish(crowd);
  }
  REQUIRE(answers(tracker, t_us));
  const auto each = (Clock::now() - probe_began) / kProbes;

  // Five times its measured capacity, or the highest sending rate.
  constexpr std::chrono::seconds kWork{5};
  const auto flood_began = Clock::now();
  std::int64_t sent = 0;
  while (sent * each < kWork) {
    crowd.start.us = ++t_us;
    tracker.publish(crowd);
    ++sent;
    std::this_thread::sleep_until(flood_began + sent * each / 5);
  }
  const std::int64_t applied_in_flood = tracker.estimates().back().events_applied;
  const EventPacket puck = puck_at({80, 60}, ++t_us);
  tracker.publish(puck);
  const std::int64_t all =
      (1 + kProbes + sent) * kEvents + static_cast<std::int64_t>(puck.events.size());
  // An estimate may include only the first events of a packet: the last one includes all.
  REQUIRE(tracker.eventually([&](const auto& estimate) {
    return estimate.sensor_us == t_us && estimate.events_applied + estimate.events_skipped == all;
  }));
  const puck_estimate_t last = tracker.estimates().back();
  // With a queue of all excess events, most would be applied only now.
  CHECK(last.events_applied - applied_in_flood < sent * kEvents / 2);

  tracker.stop();
  const std::int64_t skipped = counter(tracker.service(), "events_skipped").value();
  const std::int64_t received = counter(tracker.service(), "events_received").value();
  CHECK(skipped > 0);
  CHECK(skipped == counter(tracker.service(), "packets_skipped").value() * kEvents);
  CHECK(received == all);
  CHECK(last.events_skipped == skipped);
  CHECK(last.events_applied == received - skipped);
  CHECK(counter(tracker.service(), "events_lost") == 0);
}

}  // namespace puck
