#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include "common/io/table_file.h"
#include "common/recording/recording.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate/recording.h"

namespace puck {
namespace {

SimulationParams tiny_world() {
  SimulationParams params;
  params.sensor_size = {64, 48};
  params.autonomous_robot = true;
  return params;
}

TEST_CASE("a recording does not replace an existing size model") {
  const TemporaryFolder folder;
  const auto beside = folder / "a.size.toml";
  write_text(beside, "mine");
  SimulateSettings settings;
  settings.output = folder / "a";
  settings.seconds = 0.01;
  record(settings, tiny_world());
  CHECK(read_text(beside) == "mine");
  CHECK(read_table_file(folder / "a.toml").geometry.length_m == 2.135);
}

TEST_CASE("a recording is written in every format, with the format's ending") {
  const TemporaryFolder folder;
  SimulateSettings settings;
  settings.output = folder / "a";
  settings.seconds = 0.01;
  std::int64_t events = 0;
  for (const std::string& format : written_format_names()) {
    CAPTURE(format);
    settings.format = format;
    const RecordingSummary summary = record(settings, tiny_world());
    CHECK(summary.events > 0);
    if (format == "evt3") events = summary.events;
    const auto reader =
        open_recording(settings.output + std::string(usual_ending_of(format)), {}, "");
    EventPacket packet;
    while (reader->read(packet, 1000)) {
    }
    CHECK(reader->counters().events == events);
    CHECK(reader->counters().dropped() == 0);
  }
}

TEST_CASE("a recording notes a moving camera, even if only the scene sets it") {
  const TemporaryFolder folder;
  SimulateSettings settings;
  settings.output = folder / "a";
  settings.seconds = 0.01;
  SimulationParams params = tiny_world();
  record(settings, params);
  CHECK(read_text(folder / "a.toml").find("The camera moves") == std::string::npos);
  params.moving_camera = true;
  record(settings, params);
  CHECK(read_text(folder / "a.toml").find("The camera moves") != std::string::npos);
}

}  // namespace
}  // namespace puck
