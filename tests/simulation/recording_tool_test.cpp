#include <string>

#include <doctest/doctest.h>

#include "common/io/table_file.h"
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
