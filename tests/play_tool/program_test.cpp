#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kKeys{"shots",        "saves",   "save_percent", "save_ci_low",
                                     "save_ci_high", "speed_x", "goals",        "bound_percent"};

Finished play(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), program_path("puck-play"));
  return run_program(arguments, {.folder = source_folder()});
}

TEST_CASE("puck-play writes the figures for scripts") {
  const TemporaryFolder folder;
  const std::filesystem::path json = folder / "play.json";
  const Finished run = play({"--shots", "4", "--max-speed", "8", "--json", json, "--plots",
                             folder / "plots", "--predictions"});
  REQUIRE_MESSAGE(run.exit_code == 0, run.errors);
  const Json figures = Json::parse(read_text(json));
  for (const std::string& key : kKeys) CHECK_MESSAGE(figures.contains(key), key);
  CHECK(figures["shots"] == 4);
  CHECK(figures["saves"].get<int>() + figures["goals"].get<int>() == 4);
  CHECK(figures["save_ci_low"] < figures["save_percent"]);
  CHECK(figures["speed_x"] > 0);
  CHECK(run.output.find("shots at the robot's goal") != std::string::npos);
  CHECK(std::filesystem::file_size(folder / "plots" / "shots.png") > 5000);
  CHECK(std::filesystem::file_size(folder / "plots" / "prediction.png") > 5000);
}

TEST_CASE("puck-play writes a sweep's points and its plot") {
  const TemporaryFolder folder;
  const std::filesystem::path json = folder / "sweep.json";
  const Finished run =
      play({"--sweep", "loss", "--shots", "1", "--json", json, "--plots", folder / "plots"});
  REQUIRE_MESSAGE(run.exit_code == 0, run.errors);
  const Json points = Json::parse(read_text(json))["points"];
  REQUIRE(points.size() > 20);
  for (const Json& point : points) {
    CHECK(point.contains("value"));
    CHECK(point.contains("curve"));
    for (const std::string& key : kKeys) CHECK_MESSAGE(point.contains(key), key);
  }
  CHECK(std::filesystem::file_size(folder / "plots" / "saves_loss.png") > 1000);
}

TEST_CASE("puck-play reports that a whole game's bound is unknown") {
  const TemporaryFolder folder;
  const std::filesystem::path json = folder / "play.json";
  const Finished run = play({"--seconds", "2", "--json", json});
  REQUIRE_MESSAGE(run.exit_code == 0, run.errors);
  CHECK(Json::parse(read_text(json))["bound_percent"].is_null());
}

TEST_CASE("puck-play refuses impossible options") {
  CHECK(play({"--shots", "0"}).exit_code == 2);
  CHECK(play({"--shots", "3", "--seconds", "3"}).exit_code == 2);
  CHECK(play({"--sweep", "size"}).exit_code == 2);
  CHECK(play({"--shots", "1", "--moving"}).exit_code == 2);
  CHECK(play({"--shots", "1", "--moving", "--source", "truth"}).exit_code == 2);
  CHECK(play({"--max-speed", "nan"}).exit_code == 2);
  CHECK(play({"--seconds", "2", "--plots", "plots"}).exit_code == 2);
  const Finished no_log = play({"--log", "/nowhere/game.lcm"});
  CHECK(no_log.exit_code == 1);
  CHECK(no_log.errors.find("/nowhere/game.lcm") != std::string::npos);
  const Finished no_calibration = play({"--shots", "1", "--calibration", "/nowhere"});
  CHECK(no_calibration.exit_code == 1);
  CHECK(no_calibration.errors.find("/nowhere") != std::string::npos);
}

}  // namespace
}  // namespace puck
