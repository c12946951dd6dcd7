#include "common/runtime/shared_surface.h"

#include <random>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "tests/runtime/tracking_fixtures.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using test::kSensor;

constexpr Region kWhole = Region::all_of(kSensor);

EventPacket random_packet(Timestamp start, int count, unsigned seed) {
  std::mt19937 random(seed);
  EventPacket packet;
  packet.start = start;
  for (int i = 0; i < count; ++i) {
    packet.events.push_back({static_cast<std::uint16_t>(random() % 160),
                             static_cast<std::uint16_t>(random() % 120), 1,
                             static_cast<std::uint32_t>(i)});
  }
  return packet;
}

// The surface after the first `count` events of the packets.
SurfaceSnapshot surface_after(const std::vector<EventPacket>& packets, std::int64_t count) {
  Surface surface(kSensor, {});
  for (const EventPacket& packet : packets) {
    const std::int64_t left = count - surface.events_applied();
    if (left <= 0) break;
    const std::span<const Event> events(packet.events);
    surface.update(packet.start,
                   events.first(std::min(events.size(), static_cast<std::size_t>(left))));
  }
  SurfaceSnapshot snapshot;
  surface.snapshot(kWhole, snapshot);
  return snapshot;
}

bool same_picture(const SurfaceSnapshot& a, const SurfaceSnapshot& b) {
  const int pixels = a.grey.width() * a.grey.height();
  return a.region == b.region && std::equal(a.grey.row(0), a.grey.row(0) + pixels, b.grey.row(0));
}

}  // namespace

TEST_CASE("a snapshot is served while the event thread is idle") {
  SharedSurface shared(kSensor, {});
  const std::vector<EventPacket> packets{random_packet({5000}, 1000, 1)};
  shared.update(packets[0], {.session = 42, .received_utime = 77});
  SharedSnapshot snapshot;
  shared.snapshot(kWhole, false, snapshot);
  CHECK(snapshot.surface.events_applied == 1000);
  CHECK(snapshot.surface.newest_event == Timestamp{5999});
  CHECK(snapshot.origin.session == 42);
  CHECK(snapshot.origin.received_utime == 77);
  CHECK(snapshot.backlog_events == 0);
  CHECK(snapshot.backlog_us == 0);
  CHECK(same_picture(snapshot.surface, surface_after(packets, 1000)));
}

TEST_CASE("every snapshot of a busy surface is the surface after some number of whole events") {
  SharedSurface shared(kSensor, {});
  std::vector<EventPacket> packets;
  for (unsigned i = 0; i < 40; ++i) packets.push_back(random_packet({i * 10'000}, 5'000, i));

  std::jthread event_thread([&] {
    for (const EventPacket& packet : packets) shared.update(packet, {});
  });
  std::vector<SharedSnapshot> taken;
  std::int64_t newest = -1;
  while (newest < 40 * 5'000) {
    SharedSnapshot snapshot;
    shared.snapshot(kWhole, false, snapshot);
    REQUIRE(snapshot.surface.events_applied >= newest);
    newest = snapshot.surface.events_applied;
    if (taken.size() < 200) taken.push_back(snapshot);
  }
  event_thread.join();

  CHECK(taken.size() >= 1);
  for (std::size_t i = 0; i < taken.size(); i += 10) {
    const std::int64_t count = taken[i].surface.events_applied;
    REQUIRE(same_picture(taken[i].surface, surface_after(packets, count)));
    if (taken[i].backlog_events > 0) {
      REQUIRE((count + taken[i].backlog_events) % 5'000 == 0);
      REQUIRE(taken[i].backlog_us == taken[i].backlog_events);
    }
  }
}

TEST_CASE(
    "a surface that keeps only the requested region is dark elsewhere, without one it is whole") {
  SharedSurface shared(kSensor, {}, {.roi_only = true});
  SharedSnapshot snapshot;
  SurfaceSnapshot whole;
  whole.region = kWhole;
  whole.grey.resize(160, 120);
  shared.update({{0}, {{10, 10, 1, 0}, {110, 110, 1, 1}}}, {});
  shared.copy_part(kWhole, false, whole);
  CHECK(whole.grey(10, 10) == 255);
  shared.snapshot({100, 100, 20, 20}, false, snapshot);
  CHECK(snapshot.surface.grey(10, 10) == 255);
  shared.update({{10}, {{10, 10, 1, 0}, {110, 112, 0, 1}}}, {});
  shared.copy_part(kWhole, false, whole);
  CHECK(whole.grey(10, 10) == 0);
  CHECK(whole.grey(110, 112) == 255);
  CHECK(whole.events_applied == 4);
  // A pipeline of single events may search anywhere.
  for (const bool events : {false, true}) {
    shared.snapshot({100, 100, 20, 20}, false, snapshot);
    shared.snapshot(events ? Region{100, 100, 20, 20} : Region{}, events, snapshot);
    shared.update({{20}, {{10, 10, 1, 0}}}, {});
    shared.copy_part(kWhole, false, whole);
    CHECK(whole.grey(10, 10) == 255);
  }
}

TEST_CASE("only events in the region of the last snapshot count as news") {
  SharedSurface shared(kSensor, {});
  SharedSnapshot snapshot;
  shared.snapshot({100, 100, 20, 20}, false, snapshot);
  EventPacket elsewhere{{0}, {{10, 10, 1, 0}, {99, 100, 1, 1}}};
  shared.update(elsewhere, {});
  CHECK_FALSE(shared.wait_for_news(milliseconds(1)));
  EventPacket inside{{10}, {{10, 10, 1, 0}, {119, 119, 0, 1}}};
  shared.update(inside, {});
  CHECK(shared.wait_for_news(milliseconds(0)));
  CHECK(shared.wait_for_news(milliseconds(0)));  // until the next snapshot
  shared.snapshot({100, 100, 20, 20}, false, snapshot);
  CHECK_FALSE(shared.wait_for_news(milliseconds(1)));
}

TEST_CASE("an empty region watches the whole sensor") {
  SharedSurface shared(kSensor, {});
  SharedSnapshot snapshot;
  shared.snapshot({}, false, snapshot);
  CHECK(snapshot.surface.region.empty());
  EventPacket anywhere{{0}, {{3, 3, 1, 0}}};
  shared.update(anywhere, {});
  CHECK(shared.wait_for_news(milliseconds(0)));
}

TEST_CASE("requested events pass through a queue, and all of them are news") {
  SharedSurface shared(kSensor, {});
  SharedSnapshot snapshot;
  std::vector<Event> events;
  shared.update({{0}, {{10, 10, 1, 0}}}, {});
  shared.snapshot({100, 100, 20, 20}, true, snapshot);
  shared.update({{20}, {{10, 10, 1, 1}, {119, 119, 0, 2}}}, {});
  CHECK(shared.wait_for_news(milliseconds(0)));
  shared.snapshot({100, 100, 20, 20}, false, snapshot);
  shared.update({{40}, {{119, 119, 0, 0}}}, {});

  CHECK(shared.pop_events(snapshot.events_end, 10, events) == Timestamp{21});
  CHECK(events.size() == 2);
  shared.snapshot({}, false, snapshot);
  shared.pop_events(snapshot.events_end, 10, events);
  CHECK(events.empty());
  CHECK(shared.events_thinned() == 0);
}

TEST_CASE("what a snapshot says of its time is true of the queue, while events come") {
  constexpr int kPackets = 300;
  SharedSurface shared(kSensor, {});
  SharedSnapshot snapshot;
  shared.snapshot({}, true, snapshot);
  std::jthread event_thread([&shared] {
    std::int64_t start_us = 1;
    for (int i = 0; i < kPackets; ++i) {
      const int count = 1 + i * 37 % 350;
      shared.update(random_packet({start_us}, count, static_cast<unsigned>(i)), {.session = i});
      start_us += count;
      if (i % 4 == 0) std::this_thread::sleep_for(std::chrono::microseconds(i % 60));
    }
  });
  std::int64_t applied = 0;
  std::vector<Event> events;
  while (snapshot.origin.session < kPackets - 1 || snapshot.backlog_events > 0) {
    REQUIRE(shared.wait_for_news(std::chrono::seconds(20)));
    shared.snapshot({}, true, snapshot);
    REQUIRE(snapshot.surface.events_applied >= applied);
    applied = snapshot.surface.events_applied;
    Timestamp newest;
    while (true) {
      const Timestamp start = shared.pop_events(snapshot.events_end, 256, events);
      if (events.empty()) break;
      newest = start + events.back().offset_us;
    }
    // Without thinning, the last event before that place in the queue is the newest.
    if (newest.us > 0 && shared.events_thinned() == 0) {
      REQUIRE(newest == snapshot.surface.newest_event);
    }
  }
}

TEST_CASE("a part is copied to its place without a change of the watched region") {
  SharedSurface shared(kSensor, {});
  const std::vector<EventPacket> packets{random_packet({5000}, 1000, 1)};
  shared.update(packets[0], {});
  SharedSnapshot snapshot;
  shared.snapshot({100, 100, 20, 20}, false, snapshot);
  shared.update({{7000}, {{110, 110, 1, 0}}}, {});
  SurfaceSnapshot whole;
  whole.region = kWhole;
  whole.grey.resize(160, 120);
  shared.copy_part({0, 0, 160, 50}, false, whole);
  shared.copy_part({0, 50, 160, 70}, false, whole);
  CHECK(whole.newest_event == Timestamp{7000});
  CHECK(whole.events_applied == 1001);
  CHECK(whole.grey(110, 110) == 255);
  CHECK(shared.wait_for_news(milliseconds(0)));
}

TEST_CASE("a part of the recent pixels shows no pixel without recent events") {
  SharedSurface shared(kSensor, {});
  shared.update({{0}, {{10, 10, 1, 0}, {110, 100, 1, 1}}}, {});
  shared.update({{40'000}, {{11, 90, 1, 0}}}, {});
  SurfaceSnapshot whole;
  whole.region = kWhole;
  whole.grey.resize(160, 120);
  shared.copy_part({0, 0, 160, 50}, true, whole);
  shared.copy_part({0, 50, 160, 70}, true, whole);
  CHECK(whole.grey(10, 10) == 0);
  CHECK(whole.grey(110, 100) == 0);
  CHECK(whole.grey(11, 90) == 255);
  shared.copy_part(kWhole, false, whole);
  CHECK(whole.grey(10, 10) == 255);
  CHECK(whole.grey(110, 100) == 255);
}

TEST_CASE("a sleeping thread is woken by an event and by a call") {
  SharedSurface shared(kSensor, {});
  SharedSnapshot snapshot;
  shared.snapshot(kWhole, false, snapshot);
  const EventPacket packet = random_packet({0}, 10, 3);
  {
    std::jthread event_thread([&] { shared.update(packet, {}); });
    CHECK(shared.wait_for_news(milliseconds(60'000)));
  }
  shared.snapshot(kWhole, false, snapshot);
  std::jthread other([&] { shared.wake(); });
  CHECK_FALSE(shared.wait_for_news(milliseconds(60'000)));
}

}  // namespace puck
