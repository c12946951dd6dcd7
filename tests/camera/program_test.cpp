// The program and its shipped configuration.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "services/camera/camera_settings.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/support/child_process.h"
#include "tests/support/environment.h"

namespace puck {
namespace {

// Runs the camera on a bus of its own, with the file `input` on stdin.
Finished run_camera(std::vector<std::string> arguments, const std::filesystem::path& input = {}) {
  const std::string program = program_path("puck-camera");
  arguments.insert(arguments.begin(), {program, "--lcm-url", "memq://"});
  return run_program(arguments, {.input = input});
}

void check_refused(const std::vector<std::string>& arguments, const std::string& part) {
  CAPTURE(part);
  const Finished finished = run_camera(arguments);
  CAPTURE(finished.errors);
  CHECK(finished.exit_code == 1);
  CHECK(finished.errors.find(part) != std::string::npos);
}

TEST_CASE("the camera refuses bad input with exit code 1 and a line with the reason") {
  const CameraFolder folder;
  std::ofstream(folder / "a.png") << "\x89PNG\r\n\x1a\n";
  std::ofstream(folder / "a.toml") << "[camera]\nsauce = \"file\"\n";
  check_refused({"--set", "camera.source=file", "--set", "camera.file=/nowhere.raw"},
                "puck-camera: /nowhere.raw: cannot be opened: No such file or directory");
  check_refused(
      {"--set", "camera.source=file", "--set", "camera.file=" + (folder / "a.png").string()},
      "a.png: is a PNG image; expected Prophesee RAW");
  check_refused({"--config", folder / "a.toml"},
                "a.toml:2: unknown key camera.sauce; the nearest known key is camera.source");
  check_refused({"--set", "camera.flush_us=soon"},
                "--set camera.flush_us=soon: camera.flush_us must be an integer from 50 to 100000, "
                "got \"soon\"");
  check_refused({"--set", "camera.source=stdin"}, "stdin: is empty; expected Prophesee RAW");
  check_refused({"--config", "/nowhere.toml"}, "/nowhere.toml: cannot be opened");
}

TEST_CASE("a recording from a pipe is published to its end, and the camera ends") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(5000, 0, 10));
  const Finished finished = run_camera({"--set", "camera.source=stdin"}, folder / "a.raw");
  CHECK(finished.exit_code == 0);
  CHECK(finished.errors.find("has ended after 5000 events") != std::string::npos);
}

TEST_CASE("config/camera.toml shows every key with its default") {
  const auto path = source_folder() / "config" / "camera.toml";
  Config shipped = Config::from_file(path);
  Config defaults;
  read_camera_settings(shipped);
  read_camera_settings(defaults);
  std::istringstream shipped_lines(shipped.effective());
  std::istringstream default_lines(defaults.effective());
  std::string shown;
  for (std::string line; std::getline(default_lines, line);) {
    std::getline(shipped_lines, shown);
    CHECK(shown == line);
    CHECK(shipped.has(line.substr(0, line.find(' '))));
  }
}

}  // namespace
}  // namespace puck
