#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <thread>

#include <doctest/doctest.h>

#include "common/runtime/live_tracker.h"
#include "common/vision/paper/paper_presets.h"
#include "tests/runtime/tracking_fixtures.h"
#include "tests/support/wait_until.h"
#include "tests/vision/puck_picture.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using namespace test;

constexpr int kPackets = 200;

// The puck's contour after `i` ms, to and fro.
EventPacket packet_at(int i) {
  const int way = std::abs(i % 400 - 200);
  const Pixel truth{40 + 0.25 * way, 50 + 0.1 * way};
  return {{i * 1000}, test::contour_events(kSensor, truth, kSizeModel.at(truth), 150)};
}

// Estimates with events by publishing thread.
struct Publishers {
  std::thread::id event_thread = std::this_thread::get_id();
  std::atomic<int> by_event_thread{0};
  std::atomic<int> by_tracking_thread{0};
  std::atomic<bool> tracks{false};
  std::atomic<std::int64_t> newest_us{-1};

  void hear(const TrackedEstimate& tracked) {
    tracks = tracked.estimate.state == TrackState::kTracking;
    if (tracked.estimate.newest_event.us <= newest_us) return;
    newest_us = tracked.estimate.newest_event.us;
    ++(std::this_thread::get_id() == event_thread ? by_event_thread : by_tracking_thread);
  }
};

LiveTracker tracker_for(Publishers& publishers) {
  return LiveTracker(kSensor, correlation_params(), kSizeModel,
                     {.max_publish_hz = 100'000,
                      .heartbeat = std::chrono::seconds(10),
                      // On a busy machine or under a sanitizer a step is slow.
                      .longest_on_event_thread = std::chrono::seconds(10)},
                     [&](const TrackedEstimate& estimate) { publishers.hear(estimate); });
}

}  // namespace

TEST_CASE("a packet with none waiting behind it is answered before its update returns") {
  Publishers publishers;
  LiveTracker tracker = tracker_for(publishers);
  int i = 0;
  REQUIRE(wait_until([&] {
    tracker.update(packet_at(++i), {}, false);
    return publishers.tracks.load();
  }));
  int answered = 0;
  for (int k = 0; k < kPackets; ++k) {
    const EventPacket packet = packet_at(++i);
    tracker.update(packet, {}, false);
    if (publishers.newest_us == packet.newest().us) ++answered;
    // Lets the tracking thread fall asleep again.
    REQUIRE(wait_until([&] { return publishers.newest_us == packet.newest().us; }));
    std::this_thread::sleep_for(milliseconds(1));
  }
  // Except when the tracking thread was busy.
  CHECK(answered > kPackets / 2);
  CHECK(publishers.by_event_thread >= answered);
}

TEST_CASE("while packets wait the tracking thread makes every step") {
  Publishers publishers;
  LiveTracker tracker = tracker_for(publishers);
  for (int i = 1; i <= kPackets; ++i) {
    const EventPacket packet = packet_at(i);
    tracker.update(packet, {}, true);
    REQUIRE(wait_until([&] { return publishers.newest_us == packet.newest().us; }));
  }
  CHECK(publishers.by_event_thread == 0);
  CHECK(publishers.by_tracking_thread > 0);
}

TEST_CASE("no step is missed, whichever thread makes it") {
  Publishers publishers;
  LiveTracker tracker = tracker_for(publishers);
  for (int i = 1; i <= 2000; ++i) {
    const EventPacket later = packet_at(i);
    tracker.update(later, {}, i % 3 == 0);
    // The heartbeat, after 10 s, is too late to replace a missed step.
    if (i % 20 != 0) continue;
    const auto end = std::chrono::steady_clock::now() + milliseconds(5000);
    while (publishers.newest_us < later.newest().us && std::chrono::steady_clock::now() < end) {
      std::this_thread::yield();
    }
    REQUIRE(publishers.newest_us == later.newest().us);
  }
}

}  // namespace puck
