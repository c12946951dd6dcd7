#include "common/messaging/event_packet_view.h"

#include <algorithm>
#include <array>

#include <doctest/doctest.h>

#include "common/messaging/bus.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/message_codec.h"
#include "tests/support/random_message.h"

namespace puck {
namespace {

void check_same(const EventPacketView& view, const event_packet_t& message) {
  CHECK(view.utime == message.utime);
  CHECK(view.session == message.session);
  CHECK(view.seq == message.seq);
  CHECK(view.width == message.width);
  CHECK(view.height == message.height);
  CHECK(view.first_event_us == message.first_event_us);
  CHECK(view.duration_us == message.duration_us);
  CHECK(view.sensor_zero_utime == message.sensor_zero_utime);
  CHECK(view.events_before == message.events_before);
  CHECK(view.events_dropped == message.events_dropped);
  CHECK(view.encoding == message.encoding);
  CHECK(view.count == message.count);
  CHECK(view.size == message.size);
  CHECK(std::ranges::equal(view.data, message.data));
}

}  // namespace

TEST_CASE("a view of a packet's bytes equals the output of LCM's own decoder") {
  std::mt19937_64 random(8);
  for (int i = 0; i < 20; ++i) {
    const auto bytes = random_message(Channel::kEvents, random).bytes;
    event_packet_t message{};
    REQUIRE(decode(bytes, message) == std::nullopt);
    EventPacketView view;
    decode_checked(bytes, view);
    check_same(view, message);
    check_same(view_of(message), message);
  }
}

TEST_CASE("a subscriber to views gets checked views, with the events of the message") {
  Bus bus({.url = "memq://"});
  EventPacket received;
  int calls = 0;
  bus.subscribe<EventPacketView>([&](const EventPacketView& packet, const Receipt& receipt) {
    ++calls;
    CHECK(packet.session == bus.session());
    CHECK(receipt.arrival == Arrival::kNewSession);
    unpack(packet, received);
  });
  REQUIRE(bus.start({}, [](const std::string& reason) { MESSAGE(reason); }));
  const std::vector<Event> events{{.x = 3, .y = 4, .polarity = 1},
                                  {.x = 639, .y = 479, .offset_us = 7}};
  EventPacker packer({.sensor = {640, 480}});
  packer.pack({1000}, events, [&](event_packet_t& packet) { CHECK(bus.publish(packet)); });
  while (bus.handle(std::chrono::milliseconds(10)) > 0) continue;
  CHECK(calls == 1);
  CHECK(received.start == Timestamp{1000});
  CHECK(received.events == events);
  CHECK(bus.counters<EventPacketView>().arrivals.received == 1);
}

TEST_CASE("a packet with one bad event at any place is rejected") {
  const SensorSize sensor{600, 400};
  std::vector<Event> events(300);
  for (std::size_t i = 0; i < events.size(); ++i) {
    events[i] = {
        .x = static_cast<std::uint16_t>(i), .y = 399, .offset_us = static_cast<std::uint32_t>(i)};
  }
  EventPacker packer({.sensor = sensor});
  packer.pack({0}, events, [&](event_packet_t& packet) {
    packet.session = 1;
    std::vector<std::uint8_t> bytes;
    const auto rejection_with = [&](std::size_t i, std::uint32_t word) {
      const auto good = packet.data;
      const auto value =
          std::array{word & 0xffU, word >> 8 & 0xffU, word >> 16 & 0xffU, word >> 24};
      std::transform(value.begin(), value.end(),
                     packet.data.begin() + static_cast<std::ptrdiff_t>(4 * i),
                     [](std::uint32_t byte) { return static_cast<std::uint8_t>(byte); });
      encode(packet, bytes);
      packet.data = good;
      return check_message(Channel::kEvents, bytes).value_or("");
    };
    for (std::size_t i = 0; i < events.size(); ++i) {
      const auto dt = static_cast<std::uint32_t>(i);
      CAPTURE(i);
      REQUIRE(rejection_with(i, 599U << 22 | 399U << 13 | dt).empty());
      REQUIRE(rejection_with(i, 600U << 22 | dt) ==
              "event_packet_t has an event outside its sensor");
      REQUIRE(rejection_with(i, 400U << 13 | dt) ==
              "event_packet_t has an event outside its sensor");
      if (i > 0) {
        REQUIRE(rejection_with(i, dt - 1).empty());
        REQUIRE(rejection_with(i, 4095) ==
                (i + 1 < events.size() ? "event_packet_t has events that go back in time"
                                       : "event_packet_t has an event after its duration"));
      }
    }
  });
}

}  // namespace puck
