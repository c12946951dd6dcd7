#include "common/io/filtered_reader.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/event_writer.h"
#include "tests/io/io_fixtures.h"

namespace puck {
namespace {

TEST_CASE("a filtered reader leaves events out, counts them, and reads to the end") {
  const TemporaryFolder folder;
  std::vector<PlainEvent> events;
  for (int i = 0; i < 50; ++i) events.push_back({i, i < 40 ? 9 : i, 5, 1});
  {
    const auto writer = make_event_writer(folder / "a.raw", "evt3", {64, 48});
    writer->write(packet_of(events));
    writer->close();
  }
  const auto reader_with = [&](const EventFilterParams& params) {
    return FilteredReader(open_event_file(folder / "a.raw"), params, "a.raw");
  };
  FilteredReader masked =
      reader_with({.mask = PixelMask({64, 48}, std::vector<PixelPlace>{{9, 5}})});
  const std::vector<PlainEvent> rest(events.begin() + 40, events.end());
  CHECK(read_all(masked, 8) == rest);
  CHECK(masked.left_out().masked == 40);
  CHECK(masked.warnings() ==
        std::vector<std::string>{"a.raw: 40 events of masked pixels are left out"});
  masked.rewind();
  CHECK(masked.left_out().masked == 0);
  CHECK(read_all(masked, 100) == rest);
  CHECK(masked.left_out().masked == 40);

  FilteredReader refractory = reader_with({.refractory_us = 1000});
  CHECK(read_all(refractory, 8).size() == 11);
  refractory.rewind();
  // The pixels have no time from before.
  CHECK(read_all(refractory, 8).size() == 11);
  CHECK(refractory.left_out().refractory == 39);

  CHECK(reader_with({.turn = {.rotate_deg = 90}}).sensor_size() == SensorSize{48, 64});
  CHECK_THROWS_WITH_AS(reader_with({.mask = PixelMask({640, 480}, {}), .mask_name = "m.toml"}),
                       "m.toml is of a sensor of 640x480 px, the events are of one of 64x48 px",
                       std::invalid_argument);
}

}  // namespace
}  // namespace puck
