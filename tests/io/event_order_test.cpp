#include "common/io/event_order.h"

#include <algorithm>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"

namespace puck {
namespace {

std::vector<PlainEvent> in_order(const std::vector<std::vector<PlainEvent>>& packets,
                                 std::int64_t reorder_us, std::size_t max_events,
                                 std::int64_t* reordered = nullptr) {
  EventOrder order(reorder_us);
  std::vector<PlainEvent> events;
  EventPacket out;
  const auto take_all = [&] {
    while (order.take(out, max_events)) {
      CHECK(out.events.size() <= max_events);
      append_plain(out, events);
    }
    CHECK(out.empty());
  };
  for (const auto& plain : packets) {
    EventPacket packet;
    packet.start = {std::min_element(plain.begin(), plain.end(), [](const auto& a, const auto& b) {
                      return a.t_us < b.t_us;
                    })->t_us};
    for (const PlainEvent& each : plain) {
      Event event;
      event.x = static_cast<std::uint16_t>(each.x);
      event.offset_us = static_cast<std::uint32_t>(each.t_us - packet.start.us);
      packet.events.push_back(event);
    }
    order.add(packet);
    CHECK(packet.empty());
    take_all();
  }
  order.finish();
  take_all();
  if (reordered != nullptr) *reordered = order.reordered();
  return events;
}

TEST_CASE("late events are put in order, within a packet and across packets") {
  std::int64_t reordered = 0;
  const auto events = in_order(
      {{{10, 1}, {30, 2}, {20, 3}}, {{15, 4}, {40, 5}}, {{40, 6}, {31, 7}}}, 25, 100, &reordered);
  CHECK(events ==
        std::vector<PlainEvent>{{10, 1}, {15, 4}, {20, 3}, {30, 2}, {31, 7}, {40, 5}, {40, 6}});
  CHECK(reordered == 3);
}

TEST_CASE("any late events come out sorted, those of one time in the order of the file") {
  std::mt19937 random(11);
  for (const std::int64_t reorder_us : {0, 1, 100, 5000}) {
    std::vector<std::vector<PlainEvent>> packets;
    std::vector<PlainEvent> all;
    std::int64_t newest_us = 1'000'000;
    for (int i = 0; i < 200; ++i) {
      auto& packet = packets.emplace_back();
      const auto size = 1 + static_cast<int>(random() % 50);
      for (int j = 0; j < size; ++j) {
        newest_us += static_cast<std::int64_t>(random() % 40);
        const auto late_us = random() % 3 == 0 && reorder_us > 0
                                 ? static_cast<std::int64_t>(random()) % reorder_us
                                 : 0;
        packet.push_back({newest_us - late_us, static_cast<int>(all.size() % 2000)});
        all.push_back(packet.back());
      }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.t_us < b.t_us; });
    for (const std::size_t max_events : {1, 7, 4096}) {
      CHECK(in_order(packets, reorder_us, max_events) == all);
    }
  }
}

TEST_CASE("of very many events at one time few are held back, and later older ones are dropped") {
  constexpr int kPackets = 200;
  constexpr int kEvents = 4096;
  EventOrder order(1'000);
  std::size_t given = 0;
  std::size_t most_held = 0;
  Timestamp newest{0};
  EventPacket out;
  for (int i = 0; i < kPackets; ++i) {
    EventPacket packet;
    packet.start = {500};
    for (int k = 0; k < kEvents; ++k) {
      Event event;
      event.offset_us = k == 0 ? 0 : 500;
      packet.events.push_back(event);
    }
    order.add(packet);
    while (order.take(out, kEvents)) {
      CHECK(out.time_of(out.events.front()) >= newest);
      newest = out.newest();
      given += out.events.size();
    }
    most_held = std::max(most_held, static_cast<std::size_t>(i + 1) * kEvents - given -
                                        static_cast<std::size_t>(order.dropped()));
  }
  CHECK(most_held <= EventOrder::kMostHeld + kEvents);
  CHECK(order.dropped() > 0);
  CHECK(order.dropped() < kPackets);
}

TEST_CASE("without reordering, events are handed on at once") {
  EventOrder order(0);
  EventPacket packet = packet_of({{5, 1, 1, 1}, {6, 2, 2, 0}});
  order.add(packet);
  EventPacket out;
  REQUIRE(order.take(out, 100));
  CHECK(out.events.size() == 2);
  CHECK_THROWS_AS(EventOrder(-1), std::invalid_argument);
}

}  // namespace
}  // namespace puck
