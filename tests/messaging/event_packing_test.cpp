#include "common/messaging/event_packing.h"

#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "common/messaging/message_codec.h"

namespace puck {
namespace {

std::vector<Event> random_events(SensorSize sensor, std::size_t count, std::uint32_t step_us) {
  std::mt19937 random(1);
  std::vector<Event> events(count);
  std::uint32_t time_us = 0;
  for (Event& event : events) {
    time_us += static_cast<std::uint32_t>(random() % (step_us + 1));
    event.x = static_cast<std::uint16_t>(random() % static_cast<unsigned>(sensor.width));
    event.y = static_cast<std::uint16_t>(random() % static_cast<unsigned>(sensor.height) & 0x7fffU);
    event.polarity = random() & 1U;
    event.offset_us = time_us;
  }
  return events;
}

std::string problem_with(const EventPackerParams& params) {
  try {
    EventPacker packer(params);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("packed events are unpacked unchanged, on sensors of every encoding") {
  struct Case {
    SensorSize sensor;
    std::int32_t encoding;
  };
  for (const Case& known :
       {Case{{640, 480}, event_packet_t::ENCODING_X10_Y9_DT12},
        Case{{1024, 512}, event_packet_t::ENCODING_X10_Y9_DT12},
        Case{{1025, 512}, event_packet_t::ENCODING_X11_Y10_DT10},
        Case{{640, 513}, event_packet_t::ENCODING_X11_Y10_DT10},
        Case{{1280, 720}, event_packet_t::ENCODING_X11_Y10_DT10},
        Case{{2048, 1024}, event_packet_t::ENCODING_X11_Y10_DT10},
        Case{{2048, 2048}, event_packet_t::ENCODING_X11_Y11_DT9}, Case{{1, 1}, 1}}) {
    const SensorSize sensor = known.sensor;
    CAPTURE(sensor.width);
    CAPTURE(sensor.height);
    const auto events = random_events(sensor, 5000, 9);
    const Timestamp start{123'456'789'012};
    EventPacker packer({.sensor = sensor});
    CHECK(packer.encoding() == known.encoding);

    std::vector<Event> unpacked;
    std::vector<std::uint8_t> bytes;
    EventPacket part;
    packer.pack(start, events, [&](event_packet_t& packet) {
      CHECK(packet.events_before == static_cast<std::int64_t>(unpacked.size()));
      packet.session = 1;
      encode(packet, bytes);
      event_packet_t received{};
      REQUIRE(decode(bytes, received) == std::nullopt);
      unpack(received, part);
      REQUIRE(part.start == start + events[unpacked.size()].offset_us);
      for (Event event : part.events) {
        event.offset_us = static_cast<std::uint32_t>(part.time_of(event) - start);
        unpacked.push_back(event);
      }
      CHECK(packet.duration_us == part.events.back().offset_us);
    });
    CHECK(unpacked == events);
    CHECK(packer.events_packed() == 5000);
  }
}

TEST_CASE("a packet fits one frame, with LCM's header and the longest channel name") {
  EventPacker packer({.sensor = {640, 480}});
  CHECK(packer.max_events() == 335);  // (1472 - 8 - 29 - 93) / 4
  const auto events = random_events({640, 480}, 1000, 0);
  std::vector<int> counts;
  std::vector<std::uint8_t> bytes;
  packer.pack({0}, events, [&](event_packet_t& packet) {
    counts.push_back(packet.count);
    encode(packet, bytes);
    CHECK(8 + std::string("ABCDEFGHIJKLMNOP_PUCK_EVENTS").size() + 1 + bytes.size() <= 1472);
  });
  CHECK(counts == std::vector<int>{335, 335, 330});
}

TEST_CASE("a packet never exceeds its size limit, for any events") {
  const auto events = random_events({640, 480}, 1000, 0);
  std::vector<std::uint8_t> bytes;
  for (int most = 256; most < 264; ++most) {
    EventPacker packer({.sensor = {640, 480}, .packet_bytes = most});
    packer.pack({0}, events, [&](event_packet_t& packet) {
      encode(packet, bytes);
      REQUIRE(8 + 29 + static_cast<int>(bytes.size()) <= most);
    });
  }
}

TEST_CASE("a packet of 60000 bytes holds 14967 events, and a receiver accepts it") {
  EventPacker packer({.sensor = {640, 480}, .packet_bytes = 60000});
  CHECK(packer.max_events() == 14967);
  const auto events = random_events({640, 480}, 14967, 0);
  int packets = 0;
  std::vector<std::uint8_t> bytes;
  packer.pack({0}, events, [&](event_packet_t& packet) {
    ++packets;
    packet.session = 1;
    encode(packet, bytes);
    CHECK(check_message(Channel::kEvents, bytes) == std::nullopt);
  });
  CHECK(packets == 1);
}

TEST_CASE("a new packet begins where the time since the first event would not fit") {
  const std::vector<Event> events{{.offset_us = 10}, {.offset_us = 4105}, {.offset_us = 4106}};
  EventPacker packer({.sensor = {640, 480}});
  std::vector<std::int64_t> starts;
  std::vector<std::int64_t> durations;
  packer.pack({1000}, events, [&](event_packet_t& packet) {
    starts.push_back(packet.first_event_us);
    durations.push_back(packet.duration_us);
  });
  CHECK(starts == std::vector<std::int64_t>{1010, 5106});
  CHECK(durations == std::vector<std::int64_t>{4095, 0});
}

TEST_CASE("a new packet begins where time steps back") {
  const std::vector<Event> events{{.offset_us = 10}, {.offset_us = 20}, {.offset_us = 15}};
  EventPacker packer({.sensor = {640, 480}});
  std::vector<std::int64_t> starts;
  packer.pack({0}, events,
              [&](event_packet_t& packet) { starts.push_back(packet.first_event_us); });
  CHECK(starts == std::vector<std::int64_t>{10, 15});
}

TEST_CASE("events outside the sensor are left out and counted") {
  const std::vector<Event> events{{.x = 320}, {.x = 1}, {.x = 319, .y = 240}, {.x = 319, .y = 239}};
  EventPacker packer({.sensor = {320, 240}});
  EventPacket unpacked;
  packer.pack({0}, events, [&](event_packet_t& packet) { unpack(packet, unpacked); });
  CHECK(unpacked.events == std::vector<Event>{{.x = 1}, {.x = 319, .y = 239}});
  CHECK(packer.events_outside() == 2);
  CHECK(packer.events_packed() == 2);

  int packets = 0;
  packer.pack({0}, std::vector<Event>{{.x = 320}}, [&](event_packet_t&) { ++packets; });
  CHECK(packets == 0);
  CHECK(packer.events_outside() == 3);
}

TEST_CASE("a sensor or packets of an impossible size are refused") {
  CHECK(problem_with({.sensor = {0, 480}}) ==
        "packer.sensor must be 1x1 to 2048x2048 px, got 0x480");
  CHECK(problem_with({.sensor = {2049, 1}}) ==
        "packer.sensor must be 1x1 to 2048x2048 px, got 2049x1");
  CHECK(problem_with({.sensor = {1, 1}, .packet_bytes = 255}) ==
        "packer.packet_bytes must be 256 to 60000, got 255");
  CHECK(problem_with({.sensor = {1, 1}, .packet_bytes = 60001}) ==
        "packer.packet_bytes must be 256 to 60000, got 60001");
}

}  // namespace puck
