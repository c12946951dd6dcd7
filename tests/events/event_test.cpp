#include <doctest/doctest.h>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

TEST_CASE("an event holds the last pixel of the largest sensor and both polarities") {
  const Event event{2047, 2047, 1, 4'294'967'295u};
  CHECK(event.x == 2047);
  CHECK(event.y == 2047);
  CHECK(event.polarity == 1);
  CHECK(event.offset_us == 4'294'967'295u);
  CHECK(Event{3, 4, 0, 5} != Event{3, 4, 1, 5});
}

TEST_CASE("an event's time is its packet's start plus its offset, beyond 32 bits too") {
  EventPacket packet;
  packet.start = {5'000'000'000'000};
  packet.events = {{1, 2, 0, 0}, {3, 4, 1, 4'000'000'000u}};
  CHECK(packet.newest() == Timestamp{5'004'000'000'000});
  CHECK(packet.newest() - packet.start == 4'000'000'000);
}

TEST_CASE("timestamps are ordered and shifted in microseconds") {
  CHECK(Timestamp{7} > Timestamp{6});
  CHECK(Timestamp{7} + 3 == Timestamp{10});
  CHECK(Timestamp{7} - 10 == Timestamp{-3});
}

TEST_CASE("a sensor is 1 to 2048 pixels wide and high") {
  CHECK(SensorSize{640, 480}.is_valid());
  CHECK(SensorSize{2048, 1}.is_valid());
  CHECK_FALSE(SensorSize{2049, 480}.is_valid());
  CHECK_FALSE(SensorSize{640, 0}.is_valid());
  CHECK_FALSE(SensorSize{-1, 480}.is_valid());
}

TEST_CASE("a sensor contains its corners and no pixel beyond") {
  const SensorSize size{640, 480};
  CHECK(size.contains(0, 0));
  CHECK(size.contains(639, 479));
  CHECK_FALSE(size.contains(640, 0));
  CHECK_FALSE(size.contains(0, 480));
  CHECK_FALSE(size.contains(-1, 0));
}

}  // namespace puck
