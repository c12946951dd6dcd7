#include "common/io/pixel_mask_file.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

TEST_CASE("a pixel mask, even an empty one, is unchanged by its file") {
  const TemporaryFolder folder;
  const std::vector<PixelPlace> pixels{{7, 0}, {3, 40}, {639, 479}};
  write_pixel_mask_file(folder / "mask.toml", PixelMask({640, 480}, pixels), "found");
  const PixelMask again = read_pixel_mask_file(folder / "mask.toml");
  CHECK(again.sensor() == SensorSize{640, 480});
  CHECK(again.pixels() == pixels);
  CHECK(read_text(folder / "mask.toml").starts_with("# found\n"));
  write_pixel_mask_file(folder / "none.toml", PixelMask({640, 480}, {}), "found");
  CHECK(read_pixel_mask_file(folder / "none.toml").pixels().empty());
}

TEST_CASE("a pixel mask with a half pair, a fraction, a stray pixel or no sensor is refused") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto path = folder.write("mask.toml", "[pixel_mask]\n" + text);
    return message_of<ConfigError>([&] { read_pixel_mask_file(path); });
  };
  const std::string sensor = "width = 64\nheight = 48\n";
  CHECK(refusal(sensor + "pixels = [1, 2]\n").empty());
  CHECK(contains(refusal(sensor + "pixels = [1, 2, 3]\n"),
                 "mask.toml:4: pixel_mask.pixels must be "
                 "pairs of x and y"));
  CHECK(contains(refusal(sensor + "pixels = [1, 2.5]\n"), "must be whole numbers"));
  CHECK(contains(refusal(sensor + "pixels = [1, 48]\n"), "(1, 48) lies outside the sensor"));
  CHECK(contains(refusal("height = 48\npixels = []\n"), "pixel_mask.width is missing"));
}

}  // namespace
}  // namespace puck
