// The camera's small parts without a bus or a clock.
#include <doctest/doctest.h>

#include "services/camera/event_batcher.h"
#include "services/camera/growing_time.h"
#include "services/camera/pacer.h"
#include "services/camera/sensor_zero.h"
#include "services/camera/truth_messages.h"

namespace puck {
namespace {

using std::chrono::microseconds;

EventPacket packet_at(std::int64_t start_us, std::initializer_list<std::uint32_t> offsets_us) {
  EventPacket packet;
  packet.start = {start_us};
  for (const std::uint32_t offset_us : offsets_us) {
    Event event;
    event.offset_us = offset_us;
    packet.events.push_back(event);
  }
  return packet;
}

TEST_CASE("a full batch is sent with its last event") {
  EventBatcher batcher(2, 500, 500);
  const EventPacket packet = packet_at(1000, {0, 10, 20});
  std::size_t next = 0;
  batcher.take(packet, next);
  CHECK(next == 2);
  CHECK(batcher.is_complete({1020}));
  CHECK(batcher.due().us == 1010);
  CHECK(batcher.batch().events.size() == 2);
}

TEST_CASE("a batch is sent when its first event reaches the longest wait") {
  EventBatcher batcher(100, 500, 500);
  const EventPacket packet = packet_at(1000, {7, 506, 507});
  std::size_t next = 0;
  batcher.take(packet, next);
  CHECK(next == 2);
  CHECK(batcher.batch().start.us == 1007);
  CHECK(batcher.batch().events[1].offset_us == 499);
  CHECK_FALSE(batcher.is_complete({1506}));
  CHECK(batcher.is_complete({1507}));
  CHECK(batcher.due().us == 1507);
}

TEST_CASE("a batch takes events from several packets, and loses none between batches") {
  EventBatcher batcher(100, 500, 500);
  std::size_t next = 0;
  batcher.take(packet_at(0, {0, 100}), next);
  CHECK_FALSE(batcher.is_complete({100}));
  next = 0;
  const EventPacket second = packet_at(200, {0, 400, 500});
  batcher.take(second, next);
  CHECK(next == 1);
  REQUIRE(batcher.is_complete({700}));
  CHECK(batcher.batch().events.size() == 3);
  CHECK(batcher.batch().events[2].offset_us == 200);
  batcher.clear();
  batcher.take(second, next);
  CHECK(next == 3);
  CHECK(batcher.batch().start.us == 600);
  CHECK(batcher.batch().events.size() == 2);
}

TEST_CASE("a small batch waits longer, until it has enough events") {
  EventBatcher batcher(1000, 500, 4000);
  EventPacket packet{{1000}, {}};
  for (std::uint32_t i = 0; i <= EventBatcher::kFew; ++i)
    packet.events.push_back({0, 0, 0, i * 40});
  packet.events[EventBatcher::kFew].offset_us = 5000;
  const std::int64_t newest_us = 1000 + (EventBatcher::kFew - 1) * 40;
  std::size_t next = 0;
  batcher.take({packet.start, {packet.events.begin(), packet.events.begin() + 10}}, next);
  CHECK(batcher.age_limit_us() == 4000);
  CHECK_FALSE(batcher.is_complete({4999}));
  CHECK(batcher.is_complete({5000}));
  CHECK(batcher.due().us == 5000);
  batcher.take(packet, next);
  CHECK(next == EventBatcher::kFew);
  CHECK(batcher.age_limit_us() == 500);
  CHECK(batcher.is_complete({newest_us}));
  CHECK(batcher.due().us == newest_us);
}

TEST_CASE("a batch takes no more events from one call than the shorter wait covers") {
  EventPacket packet;
  for (std::uint32_t i = 0; i < 400; ++i) packet.events.push_back({1, 1, 1, 10 * i});
  EventBatcher batcher(10'000, 500, 4'000);
  std::size_t next = 0;
  batcher.take(packet, next);
  CHECK(next == 50);
  CHECK(batcher.is_complete({500}));
  CHECK(batcher.due() == Timestamp{500});
  EventBatcher short_ones(10, 500, 4'000);
  next = 0;
  short_ones.take(packet, next);
  CHECK(next == 10);
}

TEST_CASE("sensor time advances at its speed on the host's clock") {
  Pacer pacer(2);
  const Pacer::Clock::time_point start{};
  pacer.start({1000}, start);
  CHECK(pacer.due({1000}) == start);
  CHECK(pacer.due({3000}) == start + microseconds(1000));
}

TEST_CASE("a sensor time beyond the clock's range is due late, not in the past") {
  Pacer pacer(0.001);
  const Pacer::Clock::time_point start{};
  pacer.start({0}, start);
  CHECK(pacer.due({std::int64_t{1} << 53}) > start + std::chrono::hours(24 * 365));
}

TEST_CASE("a short delay is made up for, a long one is skipped and reported") {
  Pacer pacer(1);
  const Pacer::Clock::time_point start{};
  pacer.start({0}, start);
  CHECK_FALSE(pacer.note({1000}, start + microseconds(900)));
  CHECK(pacer.lateness_us() == 0);
  CHECK_FALSE(pacer.note({1000}, start + microseconds(51000)));
  CHECK(pacer.lateness_us() == 50000);
  CHECK(pacer.due({2000}) == start + microseconds(2000));
  CHECK(pacer.note({2000}, start + microseconds(302000)));
  CHECK(pacer.slipped_us() == 300000);
  CHECK(pacer.lateness_us() == 0);
  CHECK(pacer.due({3000}) == start + microseconds(303000));
}

TEST_CASE("restarted clocks are joined to one increasing time") {
  GrowingTime time;
  CHECK(time.place({5000}).us == 5000);
  CHECK(time.place({6000}).us == 6000);
  time.begin_new_clock(10);
  CHECK(time.place({5000}).us == 6010);
  CHECK(time.place({5500}).us == 6510);
  time.begin_new_clock(10);
  CHECK(time.place({9000}).us == 9000);
}

TEST_CASE("a live sensor's zero is that of its least delayed packet, and follows drift") {
  SensorZero zero;
  zero.add({1000}, 101'500);
  CHECK(zero.utime() == 100'500);
  zero.add({2000}, 102'100);
  zero.add({3000}, 104'000);
  CHECK(zero.utime() == 100'100);
  for (std::int64_t t_us = 0; t_us < 60'000'000; t_us += 1'000'000) {
    zero.add({t_us}, t_us + 100'100 + t_us / 1000);
  }
  CHECK(zero.utime() > 100'100 + 35'000);
  CHECK(zero.utime() < 100'100 + 60'000);
}

TEST_CASE("truth and head of an inverted camera are turned like its events") {
  SimulatedTruth truth;
  truth.position_px = {10, 20};
  truth.head = {1, 2, 3, 4, 5, 6};
  truth.counts = {4, 3, 2, 1};
  const GroundTruth upright = to_truth_message(truth, {640, 480}, {});
  CHECK(upright.centre.x == 10);
  CHECK(upright.shots == 4);
  CHECK(upright.goals_for == 1);
  const PictureTurn half_turn{.rotate_deg = 180};
  const GroundTruth turned = to_truth_message(truth, {640, 480}, half_turn);
  CHECK(turned.centre.x == 629);
  CHECK(turned.centre.y == 459);
  const HeadState head = to_head_message(truth, half_turn);
  CHECK(head.yaw_deg == -1);
  CHECK(head.pitch_deg == -2);
  CHECK(head.roll_deg == 3);
  const PictureTurn mirror{.flip_x = true};
  CHECK(to_truth_message(truth, {640, 480}, mirror).centre.x == 629);
  CHECK(to_truth_message(truth, {640, 480}, mirror).centre.y == 20);
  const HeadState mirrored = to_head_message(truth, mirror);
  CHECK(mirrored.yaw_deg == -1);
  CHECK(mirrored.pitch_deg == 2);
  CHECK(mirrored.roll_deg == -3);
}

}  // namespace
}  // namespace puck
