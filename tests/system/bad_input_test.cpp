// Common mistakes: each program reports one line with the expected form.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

/// A call that must be refused; FOLDER stands for the folder of bad files.
struct Refused {
  std::string program;
  std::vector<std::string> arguments;
  std::vector<std::string> said;  ///< Parts of the one line.
};

std::string with_folder(std::string text, const TemporaryFolder& folder) {
  const std::string marker = "FOLDER";
  const auto at = text.find(marker);
  if (at != std::string::npos) text.replace(at, marker.size(), folder.path().string());
  return text;
}

Finished run(const std::string& name, const std::vector<std::string>& arguments,
             const TemporaryFolder& folder) {
  std::vector<std::string> command{program(name)};
  for (const std::string& argument : arguments) command.push_back(with_folder(argument, folder));
  return run_program(command, {.folder = source_folder()});
}

void check_refused(const Refused& refused, const TemporaryFolder& folder) {
  CAPTURE(refused.program);
  CAPTURE(refused.said.front());
  const Finished finished = run(refused.program, refused.arguments, folder);
  CAPTURE(finished.errors);
  CHECK(finished.exit_code == 1);
  CHECK(std::count(finished.errors.begin(), finished.errors.end(), '\n') == 1);
  CHECK(finished.errors.find(refused.program) != std::string::npos);
  for (const std::string& part : refused.said) {
    CAPTURE(part);
    CHECK(finished.errors.find(with_folder(part, folder)) != std::string::npos);
  }
}

// Complete except for the case's own arguments, on a bus of its own.
std::vector<std::string> service_arguments(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"--lcm-url", "memq://", "--log-level", "error"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

struct SectionKey {
  std::string service;
  std::string section;
  std::string key;
  std::string too_large;
  std::string expected;
};

const std::vector<SectionKey> kNumbers{
    {"puck-camera", "camera", "flush_us", "100001", "an integer from 50 to 100000"},
    {"puck-tracker", "tracker", "half_width_px", "9", "an integer from 1 to 8"},
    {"puck-bridge", "bridge", "valid_for_ms", "101", "an integer from "},
    {"puck-arm", "arm", "dead_man_ms", "101", "an integer from "},
    {"puck-logger", "logger", "max_bytes", "-1", "an integer of at least 0"},
};

}  // namespace

TEST_CASE("every service refuses bad settings with file, line, key and the expected form") {
  const TemporaryFolder folder;
  const std::string file = folder / "bad.toml";
  for (const SectionKey& number : kNumbers) {
    const std::string key = number.section + "." + number.key;
    const auto check = [&](const std::string& line, const std::vector<std::string>& said) {
      write_text(file, "# Settings.\n[" + number.section + "]\n" + line + "\n");
      check_refused({number.service, service_arguments({"--config", file}), said}, folder);
    };
    check("x" + number.key + " = 1",
          {file + ":3: ", "unknown key " + number.section + ".x" + number.key, "nearest", key});
    check(number.key + " = \"soon\"",
          {file + ":3: ", key + " must be " + number.expected, "got \"soon\""});
    check(number.key + " = " + number.too_large,
          {file + ":3: ", key + " must be " + number.expected, "got " + number.too_large});
    check(number.key + " = = 1", {file + ":3: ", "is not valid TOML"});
    check_refused({number.service,
                   service_arguments({"--set", key + "=soon"}),
                   {"--set " + key + "=soon", key + " must be " + number.expected}},
                  folder);
    check_refused({number.service,
                   service_arguments({"--config", "FOLDER/nowhere.toml"}),
                   {"FOLDER/nowhere.toml: cannot be opened"}},
                  folder);
  }
}

TEST_CASE("every service refuses a malformed LCM URL or prefix") {
  const TemporaryFolder folder;
  for (const std::string& service : kServices) {
    for (const char* url :
         {"", "7667", "tcp://239.255.76.67:7667", "udpm://239.255.76.67:port",
          "udpm://239.255.76.67:7667:1", "udpm://10.0.0.1:7667", "udpm://239.255.76.67:0",
          "udpm://239.255.76.67:7667?tll=1", "udpm://239.255.76.67:7667?ttl=-1"}) {
      check_refused({service, {"--lcm-url", url, "--log-level", "error"}, {"lcm.url"}}, folder);
    }
    check_refused({service, service_arguments({"--prefix", "left"}), {"lcm.prefix", "left"}},
                  folder);
  }
}

TEST_CASE("every program that reads events refuses files without any") {
  const TemporaryFolder folder;
  write_text(folder / "empty.raw", "");
  write_text(folder / "picture.raw", "\x89PNG\r\n\x1a\n");
  write_text(folder / "prose.raw", "hello world\n");
  write_text(folder / "sizeless.raw", "% evt 3.0\n");
  write_text(folder / "truth.csv", "t_us,x,y,width,height\n0,1,2,3,4\n");
  for (const std::vector<std::string>& said : std::vector<std::vector<std::string>>{
           {"nowhere.raw: cannot be opened"},
           {"empty.raw: is empty; expected"},
           {"picture.raw: is a PNG image; expected"},
           {"prose.raw:1: is neither a header of a known format nor text"},
           {"sizeless.raw: does not say how large the sensor is"}}) {
    const std::string file = "FOLDER/" + said.front().substr(0, said.front().find(':'));
    check_refused(
        {"puck-camera",
         service_arguments({"--set", "camera.source=file", "--set", "camera.file=" + file}), said},
        folder);
    check_refused({"puck-evaluate", {file, "--truth", "FOLDER/truth.csv"}, said}, folder);
  }
  check_refused(
      {"puck-camera",
       service_arguments({"--set", "camera.source=file", "--set", "camera.file=FOLDER/prose.raw",
                          "--set", "camera.width=640", "--set", "camera.height=480"}),
       {"FOLDER/prose.raw:1: is neither", "hello world"}},
      folder);
}

TEST_CASE("a truncated recording is played to its end, and the rest is reported") {
  const TemporaryFolder folder;
  REQUIRE(
      run("puck-simulate", {"--output", "FOLDER/whole", "--seconds", "0.1"}, folder).exit_code ==
      0);
  const std::string whole = read_text(folder / "whole.raw");
  write_text(folder / "cut.raw", whole.substr(0, whole.size() / 4 * 2 + 1));
  for (const Finished& finished :
       {run("puck-camera",
            {"--lcm-url", "memq://", "--log-level", "warn", "--set", "camera.source=file", "--set",
             "camera.file=FOLDER/cut.raw"},
            folder),
        run("puck-evaluate",
            {"FOLDER/cut.raw", "--as-fast-as-possible", "--size-model",
             (source_folder() / "config/calibration/simulated_size.toml").string()},
            folder)}) {
    CAPTURE(finished.errors);
    CHECK(finished.exit_code == 0);
    CHECK(finished.errors.find("cut.raw: cut off in the middle") != std::string::npos);
    CHECK(std::count(finished.errors.begin(), finished.errors.end(), '\n') == 1);
  }
}

TEST_CASE("a size model of another sensor, or one clamped in the image, is reported once") {
  const TemporaryFolder folder;
  REQUIRE(run("puck-simulate", {"--output", "FOLDER/a", "--seconds", "0.1"}, folder).exit_code ==
          0);
  write_text(folder / "model.toml",
             "[size_model]\nwidth_0 = -30\nwidth_x = 0\nwidth_y = 0.2\nheight_0 = -20\n"
             "height_x = 0\nheight_y = 0.15\n[size_range]\nsensor_width = 1280\n"
             "sensor_height = 720\n");
  const Finished finished =
      run("puck-evaluate", {"FOLDER/a.raw", "--size-model", "FOLDER/model.toml"}, folder);
  CAPTURE(finished.errors);
  CHECK(finished.exit_code == 0);
  CHECK(finished.errors.find("fitted for a sensor of 1280x720 px, this one has 640x480") !=
        std::string::npos);
  CHECK(finished.errors.find("-30.0 x -20.0 px at (0, 0), where 3.0 x 3.0 px are used") !=
        std::string::npos);
  CHECK(std::count(finished.errors.begin(), finished.errors.end(), '\n') == 2);
}

TEST_CASE("every program refuses impossible calibrations, tables and scenes") {
  const TemporaryFolder folder;
  write_text(folder / "short.csv", "t_us,x,y,width,height\n0,1,2,3,4\n10,1,2,3\n");
  write_text(folder / "words.csv", "t_us,x,y,width,height\n0,1,two,3,4\n");
  write_text(folder / "header.csv", "a,b\n1,2\n");
  write_text(folder / "scene.toml", "[world]\nsede = 1\n");
  write_text(folder / "scene2.toml", "[world]\nseed = \"one\"\n");
  write_text(folder / "scene3.toml", "[table]\n\nlength_m = -1.0\n");
  write_text(folder / "scene4.toml", "[game]\nwait_min_s = 2.0\n");
  write_text(folder / "mask.toml", "[pixel_mask]\nwidth = 64\nheight = 48\npixels = []\n");
  write_text(folder / "model.toml", "[size_model]\nwidth_0 = \"wide\"\n");
  REQUIRE(run("puck-simulate", {"--output", "FOLDER/a", "--seconds", "0.1"}, folder).exit_code ==
          0);
  const std::vector<Refused> table{
      {"puck-tracker",
       service_arguments({"--set", "tracker.size_model=FOLDER/model.toml"}),
       {"FOLDER/model.toml:2: size_model.width_0 must be", "wide"}},
      {"puck-bridge",
       service_arguments({"--set", "bridge.table=FOLDER/nowhere.toml"}),
       {"FOLDER/nowhere.toml: cannot be opened"}},
      {"puck-arm", service_arguments({"--set", "arm.mode=follow"}), {"arm.table is needed"}},
      {"puck-arm", service_arguments({"--set", "arm.mode=dance"}), {"arm.mode must be", "dance"}},
      {"puck-logger",
       service_arguments({"--set", "logger.path=/nowhere/a.lcm"}),
       {"/nowhere/a.lcm: cannot be written"}},
      {"puck-camera",
       service_arguments({"--set", "camera.scene=FOLDER/scene.toml"}),
       {"FOLDER/scene.toml:2: unknown key", "sede"}},
      {"puck-simulate",
       {"--output", "FOLDER/x", "--scene", "FOLDER/scene.toml"},
       {"FOLDER/scene.toml:2: unknown key world.sede", "world.seed"}},
      {"puck-simulate",
       {"--output", "FOLDER/x", "--scene", "FOLDER/scene2.toml"},
       {"FOLDER/scene2.toml:2: world.seed must be an integer", "\"one\""}},
      {"puck-simulate",
       {"--output", "FOLDER/x", "--scene", "FOLDER/scene3.toml"},
       {"FOLDER/scene3.toml:3: table.length_m must be", "-1"}},
      {"puck-simulate",
       {"--output", "FOLDER/x", "--scene", "FOLDER/scene4.toml"},
       {"FOLDER/scene4.toml: game.wait_min_s must not be more than game.wait_max_s"}},
      {"puck-simulate",
       {"--output", "/nowhere/x", "--seconds", "0.01"},
       {"/nowhere/x.raw: cannot be opened for writing"}},
      {"puck-calibrate",
       {"size", "FOLDER/short.csv", "--output", "FOLDER/x.toml"},
       {"FOLDER/short.csv:3: "}},
      {"puck-calibrate",
       {"size", "FOLDER/words.csv", "--output", "FOLDER/x.toml"},
       {"FOLDER/words.csv:2: ", "two"}},
      {"puck-calibrate",
       {"table", "FOLDER/header.csv", "--output", "FOLDER/x.toml"},
       {"FOLDER/header.csv:1: ", "x_px"}},
      {"puck-calibrate",
       {"size", "FOLDER/nowhere.csv", "--output", "FOLDER/x.toml"},
       {"FOLDER/nowhere.csv: cannot be opened"}},
      {"puck-evaluate",
       {"FOLDER/a.raw", "--truth", "FOLDER/nowhere.csv", "--size-model",
        "config/calibration/simulated_size.toml"},
       {"FOLDER/nowhere.csv: cannot be opened"}},
      {"puck-evaluate",
       {"FOLDER/a.raw", "--truth", "FOLDER/short.csv", "--size-model",
        "config/calibration/simulated_size.toml"},
       {"FOLDER/short.csv:3: "}},
      {"puck-evaluate",
       {"FOLDER/a.raw", "--truth", "FOLDER/a.truth.csv", "--size-model", "FOLDER/model.toml"},
       {"FOLDER/model.toml:2: size_model.width_0 must be", "wide"}},
      {"puck-evaluate",
       {"FOLDER/a.raw", "--truth", "FOLDER/a.truth.csv", "--size-model",
        "config/calibration/simulated_size.toml", "--detection-region", "1,2,3"},
       {"1,2,3"}},
      {"puck-evaluate",
       {"FOLDER/a.raw", "--as-fast-as-possible", "--size-model",
        "config/calibration/simulated_size.toml", "--hot-pixel-mask", "FOLDER/mask.toml"},
       {"FOLDER/mask.toml is of a sensor of 64x48 px, the events are of one of 640x480 px"}},
      {"puck-calibrate",
       {"lag", "FOLDER/a.raw", "--truth", "FOLDER/a.truth.csv", "--size-model",
        "config/calibration/simulated_size.toml", "--output", "FOLDER/x.toml"},
       {"FOLDER/a.raw: "}},
      {"puck-calibrate",
       {"hot-pixels", "FOLDER/a.raw", "--output", "FOLDER/x.toml"},
       {"FOLDER/a.raw: hot pixels need a second of events or more"}},
      {"puck-calibrate",
       {"size", "FOLDER/a.annotations.csv", "--output", "FOLDER/a.annotations.csv"},
       {"FOLDER/a.annotations.csv: --output would overwrite the input"}},
      {"puck-calibrate",
       {"lag", "FOLDER/a.raw", "--truth", "FOLDER/a.truth.csv", "--size-model",
        "config/calibration/simulated_size.toml", "--output", "FOLDER/a.truth.csv"},
       {"FOLDER/a.truth.csv: --output would overwrite the input"}},
      {"puck-evaluate",
       {"FOLDER/a.raw", "--truth", "FOLDER/a.truth.csv", "--size-model",
        "config/calibration/simulated_size.toml", "--plots", "FOLDER/a.raw"},
       {"FOLDER/a.raw: the folder cannot be created"}},
      {"puck-evaluate",
       {"FOLDER/a.raw", "--size-model", "config/calibration/simulated_size.toml",
        "--detection-region", "640,0,50,50"},
       {"tracker.detection_region lies outside the sensor"}},
      {"puck-evaluate",
       {"FOLDER/a.raw", "--size-model", "config/calibration/simulated_size.toml", "--start", "99"},
       {"s long: nothing is left from 99.000 s on"}},
      {"puck-evaluate",
       {"FOLDER/a.raw", "--size-model", "config/calibration/simulated_size.toml", "--algorithm",
        "cluster", "--search-delay", "5000"},
       {"--search-delay needs algorithm puck"}},
      {"puck-demo-report", {"FOLDER/nowhere.lcm"}, {"FOLDER/nowhere.lcm: cannot be read"}},
      {"puck-demo-report", {"FOLDER/a.raw"}, {"FOLDER/a.raw: is not an LCM log"}},
  };
  for (const Refused& refused : table) check_refused(refused, folder);
}

TEST_CASE("every program answers a wrong command line with 2, and --help with 0") {
  const TemporaryFolder folder;
  std::vector<Refused> wrong{{"puck-simulate", {}},
                             {"puck-simulate", {"--output", "FOLDER/x", "--seconds", "long"}},
                             {"puck-simulate", {"--output", "FOLDER/x", "--format", "avi"}},
                             {"puck-simulate", {"--output", "FOLDER/x", "--seconds", "nan"}},
                             {"puck-calibrate", {}},
                             {"puck-calibrate", {"colour", "x.csv"}},
                             {"puck-calibrate", {"size", "x.csv"}},
                             {"puck-evaluate", {}},
                             {"puck-evaluate", {"x.raw", "--algorithm", "best"}},
                             {"puck-evaluate", {"x.raw", "--preset", "best"}},
                             {"puck-evaluate", {"x.raw", "--surface", "scarf"}},
                             {"puck-evaluate", {"x.raw", "--rate", "0"}},
                             {"puck-evaluate", {"x.raw", "--rate", "nan"}},
                             {"puck-evaluate", {"x.raw", "--rate", "9", "--real-time"}},
                             {"puck-demo-report", {}}};
  for (const std::string& service : kServices) {
    wrong.push_back({service, {"--bogus"}});
    wrong.push_back({service, {"--log-level", "loud"}});
    wrong.push_back({service, {"--config"}});
  }
  for (const Refused& call : wrong) {
    CAPTURE(call.program);
    const Finished finished = run(call.program, call.arguments, folder);
    CHECK(finished.exit_code == 2);
    CHECK_FALSE(finished.errors.empty());
    const Finished help = run(call.program, {"--help"}, folder);
    CHECK(help.exit_code == 0);
    CHECK(help.output.find(call.program) != std::string::npos);
  }
}

}  // namespace puck
