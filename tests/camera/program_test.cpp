// The program and its shipped configuration.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "services/camera/camera_settings.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/support/child_process.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/terminal_process.h"
#include "tests/support/test_url.h"
#include "tests/support/wait_until.h"

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
  for (const auto& [content, kind] : std::vector<std::pair<std::string, std::string>>{
           {"#!AER-DAT4.0\r\n", "an AEDAT4 file"}, {"\x89HDF\r\n\x1a\n", "an HDF5 file"}}) {
    std::ofstream(folder / "stream") << content << std::string(8192, ' ');
    const Finished finished = run_camera({"--set", "camera.source=stdin"}, folder / "stream");
    CHECK(finished.exit_code == 1);
    CHECK(contains(finished.errors, "stdin: is " + kind +
                                        ", which cannot be read from a live stream; expected "
                                        "Prophesee RAW"));
  }
  check_refused({"--config", "/nowhere.toml"}, "/nowhere.toml: cannot be opened");
}

TEST_CASE("a recording from a pipe is published to its end, and the camera ends") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(5000, 0, 10));
  const Finished finished = run_camera({"--set", "camera.source=stdin"}, folder / "a.raw");
  CHECK(finished.exit_code == 0);
  CHECK(finished.errors.find("has ended after 5000 events") != std::string::npos);
}

/// A camera that plays a recording on a bus of this test.
std::vector<std::string> playing_command(const std::filesystem::path& recording,
                                         const std::vector<std::string>& settings = {}) {
  std::vector<std::string> command{program_path("puck-camera"), "--lcm-url", private_lcm_url()};
  const std::vector<std::string> source{"camera.source=file", "camera.file=" + recording.string()};
  for (const std::string& setting : source) command.insert(command.end(), {"--set", setting});
  for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
  return command;
}

Finished ask_camera(const std::vector<std::string>& request) {
  std::vector<std::string> command{program_path("puck-camera"), "--lcm-url", private_lcm_url()};
  command.insert(command.end(), request.begin(), request.end());
  return run_program(command);
}

TEST_CASE(
    "another puck-camera pauses, steps, moves and speeds a running one, and tells its answer") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(60'000, 0, 1000));  // 60 s.
  CHECK(ask_camera({"--pause"}).errors ==
        "puck-camera: not confirmed to be paused within 1 s: no puck-camera is heard\n");

  ChildProcess camera(playing_command(folder / "a.raw", {"camera.paused=true"}),
                      {.errors = folder / "log"});
  REQUIRE(wait_until([&] { return contains(read_text(folder / "log"), "on the bus"); }));
  const auto check_answer = [&](const std::vector<std::string>& request, const std::string& text) {
    const Finished asked = ask_camera(request);
    CAPTURE(asked.errors);
    CHECK(asked.exit_code == 0);
    CHECK(asked.output.starts_with("puck-camera: " + text));
  };
  check_answer({"--pause"}, "paused at 0.000 s");
  check_answer({"--seek", "30"}, "paused at 30.000 s");
  check_answer({"--seek", "-10.5"}, "paused at 19.500 s");
  check_answer({"--seek", "+0.5"}, "paused at 20.000 s");
  check_answer({"--step"}, "paused at 20.00");
  check_answer({"--speed", "0.5"}, "paused at 20.00");
  check_answer({"--resume"}, "at 20.");
  check_answer({"--seek", "40"}, "at 40.");
  const Finished beyond = ask_camera({"--seek", "60.5"});
  CHECK(beyond.exit_code == 1);
  CHECK(beyond.errors.starts_with(
      "puck-camera: refused: the recording, or the part that is played, ends before that place ("));
  for (const char* place : {"nan", "soon", "1e30", ""}) {
    CHECK(ask_camera({"--seek", place}).exit_code == 2);
  }
  CHECK(ask_camera({"--speed", "nan"}).exit_code == 2);
  CHECK(ask_camera({"--pause", "--resume"}).exit_code == 2);
  camera.send(SIGTERM);
  CHECK(camera.wait_for(std::chrono::seconds(10)) == 0);
  CHECK(contains(read_text(folder / "log"), "stopped after "));
}

TEST_CASE("beside a live camera the one with a recording obeys and is named") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(60'000, 0, 1000));  // 60 s.
  // Nobody listens at this port.
  ChildProcess live(
      {program_path("puck-camera"), "--lcm-url", private_lcm_url(), "--set", "camera.source=tcp",
       "--set", "camera.tcp_host=127.0.0.1", "--set", "camera.tcp_port=1"},
      {.errors = folder / "live"});
  REQUIRE(wait_until([&] { return contains(read_text(folder / "live"), "on the bus"); }));
  const auto name_of = [](const ChildProcess& camera) {
    return ", pid " + std::to_string(camera.pid()) + ")";
  };
  const Finished refused = ask_camera({"--pause"});
  CHECK(refused.exit_code == 1);
  CHECK(contains(refused.errors, "puck-camera: refused: no camera on this bus plays a recording"));
  CHECK(contains(refused.errors, name_of(live)));

  ChildProcess camera(playing_command(folder / "a.raw"), {.errors = folder / "log"});
  REQUIRE(wait_until([&] { return contains(read_text(folder / "log"), "sensor 64x48"); }));
  const Finished paused = ask_camera({"--pause"});
  CAPTURE(paused.errors);
  CHECK(paused.exit_code == 0);
  CHECK(contains(paused.output, "paused at "));
  CHECK(contains(paused.output, name_of(camera)));
  CHECK_FALSE(contains(paused.output, name_of(live)));
  CHECK_FALSE(contains(read_text(folder / "live") + read_text(folder / "log"), "refused: for"));
}

TEST_CASE("two requests at once are both answered") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(60'000, 0, 1000));  // 60 s.
  ChildProcess camera(playing_command(folder / "a.raw", {"camera.paused=true"}),
                      {.errors = folder / "log"});
  REQUIRE(wait_until([&] { return contains(read_text(folder / "log"), "sensor 64x48"); }));
  Finished other;
  std::jthread asks([&] { other = ask_camera({"--speed", "2"}); });
  const Finished sought = ask_camera({"--seek", "30"});
  asks.join();
  CAPTURE(sought.errors);
  CAPTURE(other.errors);
  CHECK(sought.exit_code == 0);
  CHECK(sought.output.starts_with("puck-camera: paused at 30.000 s"));
  CHECK(other.exit_code == 0);
}

TEST_CASE("keys control a recording, and the terminal is as before after a signal") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(600'000, 0, 100));  // 60 s.
  for (const int signal : {SIGTERM, SIGINT}) {
    TerminalProcess camera(playing_command(folder / "a.raw"));
    const termios before = camera.settings();
    REQUIRE(camera.reads("keys: space pauses, ? shows all"));
    CHECK((camera.settings().c_lflag & (ICANON | ECHO)) == 0);
    camera.type("x?");
    CHECK(camera.reads("left and right go 1 s"));
    camera.type(" ");
    CHECK(camera.reads("paused at "));
    camera.type("\x1b[A");
    CHECK(camera.reads("searching 1"));
    CHECK(camera.reads("begins at 1"));
    camera.type("\x1b");  // In parts, as a slow line brings it.
    camera.type("OC");
    CHECK(camera.reads("searching 1"));
    CHECK(camera.reads("begins at 1"));
    camera.type(".");
    CHECK(camera.reads("paused at 1"));
    camera.type("+");
    camera.type(" ");
    CHECK(camera.reads("speed 2"));
    camera.send(signal);
    CHECK(camera.reads("stopped after "));
    CHECK(camera.wait() == 0);
    CHECK(camera.settings().c_lflag == before.c_lflag);
  }
}

TEST_CASE("a camera whose events come on stdin leaves the terminal alone") {
  TerminalProcess camera(
      {program_path("puck-camera"), "--lcm-url", "memq://", "--set", "camera.source=stdin"});
  const termios before = camera.settings();
  REQUIRE(camera.reads("on the bus"));
  CHECK(camera.settings().c_lflag == before.c_lflag);
  CHECK((before.c_lflag & ICANON) != 0);
  camera.send(SIGTERM);
  CHECK(camera.wait() == 0);
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
