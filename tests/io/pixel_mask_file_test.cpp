#include "common/io/pixel_mask_file.h"

#include <stdexcept>
#include <utility>

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "common/io/event_writer.h"
#include "common/io/masked_reader.h"
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

TEST_CASE("a masked reader leaves out masked events, counts them, and reads to the end") {
  const TemporaryFolder folder;
  std::vector<PlainEvent> events;
  for (int i = 0; i < 50; ++i) events.push_back({i, i < 40 ? 9 : i, 5, 1});
  {
    const auto writer = make_event_writer(folder / "a.raw", "evt3", {64, 48});
    writer->write(packet_of(events));
    writer->close();
  }
  MaskedReader reader(open_event_file(folder / "a.raw"),
                      PixelMask({64, 48}, std::vector<PixelPlace>{{9, 5}}), "mask");
  const std::vector<PlainEvent> rest(events.begin() + 40, events.end());
  CHECK(read_all(reader, 8) == rest);
  CHECK(reader.masked_events() == 40);
  REQUIRE(reader.warnings().size() == 1);
  CHECK(reader.warnings()[0] == "40 events of 1 masked pixels are left out");
  reader.rewind();
  CHECK(read_all(reader, 100) == rest);
  CHECK(reader.masked_events() == 40);
  CHECK_THROWS_WITH_AS(
      MaskedReader(open_event_file(folder / "a.raw"), PixelMask({640, 480}, {}), "m.toml"),
      "m.toml is of a sensor of 640x480 px, the events are of one of 64x48 px",
      std::invalid_argument);
}

}  // namespace
}  // namespace puck
