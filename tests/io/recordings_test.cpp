// Real recordings by others; the expected values are from their MANIFEST.md, the first times from
// their bytes.
#include "tests/support/recordings.h"

#include <cmath>
#include <filesystem>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/event_reader.h"
#include "common/io/truth_file.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

struct Expected {
  const char* file = nullptr;
  EventFileOptions options;
  SensorSize sensor;
  std::size_t events = 0;
  std::int64_t first_us = 0;
  double span_s = 0;      // From the manifest, rounded …
  double rounding_s = 0;  // … to this precision.
};

TEST_CASE("real recordings have the events, times and geometry of their manifest") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  const std::filesystem::path& folder = *recordings;
  const std::vector<Expected> all{
      {"sparklers_gen31_640x480_evt2.raw", {}, {640, 480}, 521252, 913716224, 0.096, 0.0005},
      {"driving_gen41_1280x720_evt3.raw", {}, {1280, 720}, 219596, 11718656, 0.0088, 0.00005},
      {"walking_640x480_evt3.extracted.raw",
       {.sensor = {640, 480}},
       {640, 480},
       343474,
       0x6cf * 4096 + 0x205,
       2.078,
       0.0005},
      {"shapes_rotation_davis240c_240x180.txt",
       {.sensor = {240, 180}},
       {240, 180},
       30000,
       43499029,
       0.106,
       0.0005},
      {"dynamic_translation_davis240c_240x180.txt",
       {.sensor = {240, 180}},
       {240, 180},
       30000,
       32886658,
       0.039,
       0.0005},
  };
  for (const Expected& expected : all) {
    CAPTURE(expected.file);
    const auto reader = open_event_file(folder / expected.file, expected.options);
    CHECK(reader->sensor_size() == expected.sensor);
    const std::vector<PlainEvent> events = read_all(*reader, 4096);
    REQUIRE(events.size() == expected.events);
    CHECK(events.front().t_us == expected.first_us);
    const double span_s = static_cast<double>(events.back().t_us - events.front().t_us) * 1e-6;
    CHECK(std::abs(span_s - expected.span_s) <= expected.rounding_s);
    CHECK(reader->warnings().empty());

    reader->rewind();
    CHECK(read_all(*reader, 77777) == events);
  }
}

TEST_CASE("recordings of other formats are refused by name") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  const std::filesystem::path& folder = *recordings;
  const auto refusal = [&](const char* file) {
    return message_of<EventFileError>([&] { open_event_file(folder / file); });
  };

  CHECK(contains(refusal("plane_320x240.es"), "is an Event Stream (.es) file; expected"));
  CHECK(contains(refusal("ncars_td.dat"), "is a Prophesee DAT file; expected"));
}

TEST_CASE("the truth of a real recording is readable, and lies within the recording") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  const std::filesystem::path& folder = *recordings;
  const auto rows = read_truth_file(folder / "shapes_rotation_davis240c_240x180.truth.csv");
  REQUIRE(rows.size() == 26);
  CHECK(rows[0].time.us == 43506029);
  CHECK(rows[0].centre == Pixel{66.6, 40.1});
  CHECK(rows[0].size.width == 33.1);
  CHECK(rows[0].size.height == 22.4);
  CHECK(rows[0].visible == 1);
}

}  // namespace
}  // namespace puck
