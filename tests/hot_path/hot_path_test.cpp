// The work for an event or an estimate allocates no memory. (A search may: it has a thread of its
// own, and no thread waits for it.)
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "common/runtime/live_tracker.h"
#include "common/vision/make_pipeline.h"
#include "common/vision/paper/puck_detector.h"
#include "common/vision/presets.h"
#include "tests/hot_path/counted_allocations.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};
// Grows from 19 to 49 px in width as it comes nearer.
constexpr PuckSizeModel kSizeModel{10, 0, 0.1, 6, 0, 0.065};
constexpr std::int64_t kPacketUs = 1000;
constexpr int kWarmUpPackets = 500;
constexpr int kPackets = 1000;

// To and fro across the image, and towards the camera all the while.
Pixel puck_at(double t_s) { return {320 + 180 * std::sin(3 * t_s), 90 + 200 * t_s}; }

bool covers(Pixel centre, int x, int y) {
  const PuckSize size = kSizeModel.at(centre);
  return std::hypot((x - centre.x) / (size.width / 2), (y - centre.y) / (size.height / 2)) < 1;
}

// A dark puck on a bright table: an event of every pixel that it covers or uncovers. Before them
// the sensor's noise, so that a tracker that a busy machine has held up notices where no puck is.
EventPacket packet_of(int number) {
  constexpr int kSteps = 5;
  constexpr int kReach = 60;
  constexpr int kNoise = 150;
  const std::int64_t start_us = number * kPacketUs;
  EventPacket packet{{start_us}, {}};
  std::mt19937 random(static_cast<unsigned>(number));
  for (int i = 0; i < kNoise; ++i) {
    packet.events.push_back({static_cast<std::uint16_t>(random() % kSensor.width),
                             static_cast<std::uint16_t>(random() % kSensor.height),
                             static_cast<std::uint16_t>(random() & 1U), 0});
  }
  for (int step = 0; step < kSteps; ++step) {
    const std::int64_t offset_us = step * kPacketUs / kSteps;
    const double t_s = static_cast<double>(start_us + offset_us) * 1e-6;
    const Pixel before = puck_at(t_s);
    const Pixel after = puck_at(t_s + 1e-6 * kPacketUs / kSteps);
    const int left = static_cast<int>(before.x) - kReach;
    const int top = static_cast<int>(before.y) - kReach;
    for (int y = std::max(top, 0); y < std::min(top + 2 * kReach, kSensor.height); ++y) {
      for (int x = std::max(left, 0); x < std::min(left + 2 * kReach, kSensor.width); ++x) {
        const bool was = covers(before, x, y);
        if (was == covers(after, x, y)) continue;
        packet.events.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                 static_cast<std::uint16_t>(was ? 1 : 0),
                                 static_cast<std::uint32_t>(offset_us)});
      }
    }
  }
  return packet;
}

// Results of the tracking thread so far.
struct Said {
  std::thread::id event_thread = std::this_thread::get_id();
  std::atomic<std::int64_t> newest_us{-1};
  std::atomic<int> estimates{0};
  std::atomic<int> tracked{0};
  std::atomic<std::int64_t> allocations{0};  // the tracking thread's own
  std::atomic<int> by_event_thread{0};       // estimates that it made and published
  std::atomic<int> by_tracking_thread{0};

  void hear(const TrackedEstimate& tracked_estimate) {
    const bool is_event_thread = std::this_thread::get_id() == event_thread;
    if (!is_event_thread) allocations = test::own_allocations();
    const std::int64_t newest = tracked_estimate.estimate.newest_event.us;
    // A heartbeat has no new events.
    if (newest > newest_us) ++(is_event_thread ? by_event_thread : by_tracking_thread);
    newest_us = newest;
    ++estimates;
    if (tracked_estimate.estimate.state == TrackState::kTracking) ++tracked;
  }
};

// Hands the packets over, each after the answer to the one before, or after 100 ms if it has no
// event in the region. Every other one as if more waited, so that either thread makes steps.
void play(LiveTracker& tracker, const Said& said, const std::vector<EventPacket>& packets,
          std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    tracker.update(packets[i], {.session = 1}, i % 2 == 0);
    for (int k = 0; k < 2000 && said.newest_us < packets[i].newest().us; ++k) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }
}

}  // namespace

TEST_CASE("memory allocations are counted") {
  const std::int64_t before = test::own_allocations();
  const auto memory = std::make_unique<int>(1);
  const std::vector<int> more(10);
  CHECK(test::own_allocations() - before == 2);
}

TEST_CASE("a second of tracking allocates nothing, in either thread") {
  std::vector<EventPacket> packets;
  for (int i = 0; i < kWarmUpPackets + kPackets; ++i) {
    EventPacket packet = packet_of(i + 1);
    if (!packet.empty()) packets.push_back(std::move(packet));
  }
  REQUIRE(packets.size() > kPackets);
  for (const Preset preset : {Preset::kDefault, Preset::kReference, Preset::kCorrelation}) {
    CAPTURE(static_cast<int>(preset));
    PipelineParams params = preset_params(preset);
    // Everywhere, not only where the authors' robot had it.
    search_params(params).detector.region = {};
    Said said;
    LiveTracker tracker(kSensor, params, kSizeModel,
                        {.max_publish_hz = 100'000,
                         // On a busy machine or under a sanitizer a step is slow.
                         .longest_on_event_thread = std::chrono::seconds(10)},
                        [&](const TrackedEstimate& estimate) { said.hear(estimate); });
    play(tracker, said, packets, 0, kWarmUpPackets);
    REQUIRE(said.tracked > 0);
    const int estimates_before = said.estimates;
    const int tracked_before = said.tracked;
    const int by_event_thread_before = said.by_event_thread;
    const int by_tracking_thread_before = said.by_tracking_thread;
    const std::int64_t tracking_before = said.allocations;
    const std::int64_t events_before = test::own_allocations();
    play(tracker, said, packets, kWarmUpPackets, packets.size());
    CHECK(test::own_allocations() == events_before);
    // The presets that correlate search when a busy machine has held them up: a search may
    // allocate, a step may not.
    const std::int64_t by_searches = preset == Preset::kDefault ? 0 : kPackets / 10;
    CHECK(said.allocations - tracking_before <= by_searches);
    // Both threads have made steps meanwhile.
    CHECK(said.by_event_thread > by_event_thread_before);
    CHECK(said.by_tracking_thread > by_tracking_thread_before);
    CHECK(said.estimates - estimates_before > kPackets / 50);
    CHECK(said.tracked - tracked_before > kPackets / 50);
  }
}

TEST_CASE("events and copies of any surface allocate nothing, even the first") {
  for (const SurfaceParams& params : {SurfaceParams(ErosParams{}), SurfaceParams(TosParams{}),
                                      SurfaceParams(SitsParams{}), SurfaceParams(SaeParams{})}) {
    CAPTURE(params.index());
    SharedSurface surface(kSensor, params);
    SharedSnapshot copy;
    copy.surface.grey.reserve(kSensor.width, kSensor.height);
    std::vector<EventPacket> packets;
    for (int i = 1; i < 20; ++i) packets.push_back(packet_of(i));
    const std::int64_t before = test::own_allocations();
    Region region{300, 80, 40, 30};
    for (const EventPacket& packet : packets) {
      surface.update(packet, {.session = 1}, false);
      surface.snapshot(region, {}, copy);
      region = region.inflated(20).intersect(Region::all_of(kSensor));
    }
    CHECK(test::own_allocations() == before);
    CHECK(copy.surface.events_applied > 0);
  }
}

TEST_CASE("search results of any number and age are taken without an allocation") {
  const auto pipeline = make_pipeline(kSensor, default_params(), kSizeModel);
  const EventPacket packet = packet_of(1);
  pipeline->take(packet.start, packet.events);
  SearchResult result{packet.newest(), pipeline->search_wanted(), {}};
  REQUIRE_FALSE(result.request.region.empty());
  for (std::size_t i = 0; i < PuckDetector::kMostDetections; ++i) {
    const auto number = static_cast<double>(i);
    result.candidates.push_back({{40 + 12 * number, 100 + 5 * number}, 0.9 - 0.01 * number});
  }
  std::vector<EventPacket> meanwhile;
  for (int i = 2; i < 20; ++i) meanwhile.push_back(packet_of(i));
  const EventPacket last = packet_of(20);

  const std::int64_t before = test::own_allocations();
  for (const EventPacket& later : meanwhile) pipeline->take(later.start, later.events);
  pipeline->take(result);
  // Live, a snapshot may be newer than the events that the pipeline has got.
  result.time = last.newest() + 5'000;
  pipeline->take(result);
  pipeline->take(last.start, last.events);
  CHECK(test::own_allocations() == before);
}

}  // namespace puck
