#include "common/events/pixel_mask.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

Event event_at(int x, int y, std::uint32_t offset_us) {
  Event event;
  event.x = static_cast<std::uint16_t>(x);
  event.y = static_cast<std::uint16_t>(y) & 0x7fff;
  event.offset_us = offset_us;
  return event;
}

TEST_CASE(
    "a mask removes the events of its pixels, counts them, and keeps the order of the others") {
  const PixelMask mask({64, 48}, std::vector<PixelPlace>{{63, 47}, {5, 6}, {5, 6}});
  CHECK(mask.pixels() == std::vector<PixelPlace>{{5, 6}, {63, 47}});
  EventPacket packet{{100},
                     {event_at(5, 6, 0), event_at(6, 5, 1), event_at(63, 47, 2), event_at(5, 6, 2),
                      event_at(5, 7, 3)}};
  CHECK(mask.remove_from(packet) == 3);
  CHECK(packet.events == std::vector<Event>{event_at(6, 5, 1), event_at(5, 7, 3)});
  CHECK(mask.remove_from(packet) == 0);
}

TEST_CASE("an event outside the mask's sensor passes") {
  const PixelMask mask({64, 48}, std::vector<PixelPlace>{{0, 1}});
  EventPacket packet{{0}, {event_at(64, 0, 0), event_at(2000, 2000, 1)}};
  CHECK(mask.remove_from(packet) == 0);
  CHECK(packet.events.size() == 2);
}

TEST_CASE("an empty mask fits every sensor, any other its own sensor only") {
  CHECK_NOTHROW(PixelMask().check_sensor({640, 480}, "mask"));
  const PixelMask mask({64, 48}, {});
  CHECK_NOTHROW(mask.check_sensor({64, 48}, "mask"));
  CHECK_THROWS_WITH_AS(mask.check_sensor({48, 64}, "camera.hot_pixel_mask"),
                       "camera.hot_pixel_mask is of a sensor of 64x48 px, the events are of one of "
                       "48x64 px",
                       std::invalid_argument);
}

TEST_CASE("a mask without a sensor, or with a pixel outside it, is refused") {
  CHECK_THROWS_AS(PixelMask({0, 48}, {}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(PixelMask({64, 48}, std::vector<PixelPlace>{{64, 0}}),
                       "the masked pixel (64, 0) lies outside the sensor of 64x48 px",
                       std::invalid_argument);
}

}  // namespace
}  // namespace puck
