#include "common/io/event_filter_config.h"

#include <string>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

EventFilterParams filter_from(const std::string& text) {
  Config config = Config::from_text("[camera]\n" + text, "c.toml");
  EventFilterParams filter = read_event_filter(config, "camera");
  config.reject_unknown();
  return filter;
}

TEST_CASE("the keys of a filter reach it; without them it is off") {
  CHECK(filter_from("").is_off());
  CHECK(filter_from("crop = []\nrotate_deg = 0\npolarity = \"both\"\n").is_off());
  const EventFilterParams filter = filter_from(
      "crop = [1, 2, 30, 40]\npolarity = \"off\"\nrefractory_us = 200\nflip_y = true\n"
      "background_activity_us = 5000\nrotate_deg = 270\n");
  CHECK(filter.crop == Region{1, 2, 30, 40});
  CHECK(filter.polarity == EventFilterParams::Polarity::kOff);
  CHECK(filter.refractory_us == 200);
  CHECK(filter.background_activity_us == 5000);
  CHECK(filter.turn == PictureTurn{.flip_x = false, .flip_y = true, .rotate_deg = 270});
  CHECK(filter_from("rotate_180 = true\n").turn.rotate_deg == 180);
}

TEST_CASE("a filter key that cannot be used is named, with what was expected and the value") {
  const auto refusal = [](const std::string& text) {
    return message_of<ConfigError>([&] { filter_from(text); });
  };
  CHECK(refusal("rotate_deg = 45\n") ==
        "c.toml:2: camera.rotate_deg must be 0, 90, 180 or 270, got 45");
  CHECK(contains(refusal("rotate_deg = -90\n"), "0, 90, 180 or 270, got -90"));
  CHECK(contains(
      refusal("rotate_deg = 90\nrotate_180 = true\n"),
      "c.toml:3: camera.rotate_180 must be false when camera.rotate_deg is set, got true"));
  CHECK(refusal("crop = [1, 2, 3]\n") ==
        "c.toml:2: camera.crop must be [] or [x, y, width, height] in whole px, got [ 1, 2, 3 ]");
  CHECK(contains(refusal("crop = [1, 2, 0, 3]\n"), "camera.crop must be"));
  CHECK(contains(refusal("crop = [1.5, 2, 3, 3]\n"), "camera.crop must be"));
  CHECK(contains(refusal("crop = \"all\"\n"), "camera.crop must be a list of numbers"));
  CHECK(refusal("polarity = \"up\"\n") ==
        "c.toml:2: camera.polarity must be \"both\", \"on\" or \"off\", got \"up\"");
  CHECK(contains(refusal("refractory_us = -1\n"),
                 "camera.refractory_us must be an integer from 0 to 10000000, got -1"));
  CHECK(contains(refusal("background_activity_us = 1.5\n"), "camera.background_activity_us must"));
  CHECK(contains(refusal("flip_x = 1\n"), "camera.flip_x must be true or false, got 1"));
  CHECK(contains(refusal("undistort = \"/nowhere.toml\"\n"), "/nowhere.toml: cannot be opened"));
}

}  // namespace
}  // namespace puck
