// tools/other_scenes.sh: with the real programs, and with stand-ins for their failure.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/child_process.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"
#include "tests/system_compare/stand_ins.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

fs::path script() { return source_folder() / "tools/other_scenes.sh"; }

Finished told_with(const std::string& evaluate) {
  const TemporaryFolder folder;
  write_text(folder / "scene.toml", "# Any scene.\n[sensor]\nthreshold = 0.3\n");
  return run_program({script(), "--programs", programs_that(folder, evaluate), "--output",
                      folder / "out", folder / "scene.toml"});
}

}  // namespace

TEST_CASE("a row has the means of two games") {
  const Finished told = told_with(
      "if [ $seed = 11 ]; then echo mean_px 0.8; echo lost_percent 10\n"
      "else echo mean_px 1.0; echo lost_percent 20; fi\n");
  INFO(told.errors);
  CHECK(told.exit_code == 0);
  CHECK(contains(told.output, "| Any scene | 0.90 / 15.00 | 0.90 / 15.00 |\n"));
}

TEST_CASE("a failure in one game removes the row") {
  const std::string good = "echo mean_px 0.8; echo lost_percent 10\n";
  const std::vector<std::string> failures{
      "if [ $seed = 11 ]; then exit 1; fi\n" + good, "if [ $seed = 12 ]; then exit 1; fi\n" + good,
      good + "exit 1\n",
      "if [ $seed = 12 ]; then echo mean_px -; echo lost_percent -; exit; fi\n" + good,
      "echo lost_percent 10\n"};
  for (const std::string& evaluate : failures) {
    CAPTURE(evaluate);
    const Finished told = told_with(evaluate);
    CHECK(told.exit_code == 1);
    CHECK_FALSE(contains(told.output, "Any scene"));
    CHECK(contains(told.errors, "scene failed"));
  }
}

TEST_CASE("another scene is played, and an impossible one does not affect the other rows") {
  const TemporaryFolder folder;
  write_text(folder / "bad.toml", "# A key that nobody knows.\n[sensor]\nthreshhold = 1.0\n");
  const Finished told =
      run_program({script(), "--seconds", "2", "--programs", required_environment("PUCK_BIN_DIR"),
                   "--output", folder / "out", folder / "bad.toml",
                   source_folder() / "tools/compare/other_scenes/sensor_240x180.toml"},
                  {}, std::chrono::minutes(8));
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 1);
  CHECK(contains(told.errors, "threshhold"));
  CHECK_FALSE(contains(told.output, "A key that nobody knows"));

  const std::string name = "| A sensor of 240 x 180 px | ";
  const auto row = told.output.find(name);
  REQUIRE(row != std::string::npos);
  double still_px = -1;
  double still_lost = -1;
  double moving_px = -1;
  double moving_lost = -1;
  REQUIRE(std::sscanf(told.output.c_str() + row + name.size(), "%lf / %lf | %lf / %lf |", &still_px,
                      &still_lost, &moving_px, &moving_lost) == 4);
  CHECK(still_px > 0.0);
  CHECK(still_px < 1.0);
  CHECK(still_lost < 5.0);
  CHECK(moving_px > 0.0);
  CHECK(moving_px < 5.0);
  CHECK(moving_lost < 10.0);
}

TEST_CASE("impossible requests are refused before any run") {
  const Finished help = run_program({script(), "--help"});
  CHECK(help.exit_code == 0);
  CHECK(contains(help.output, "--programs DIR"));

  const TemporaryFolder folder;
  fs::create_directory(folder / "other");
  write_text(folder / "scene.toml", "");
  write_text(folder / "other/scene.toml", "");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"no_such_scene.toml"},
           {"--seconds", "1.2.3"},
           {"--jobs", "0"},
           {"--no-such-option"},
           {"--programs", folder / "other"},
           {folder / "scene.toml", folder / "other/scene.toml"}}) {
    CAPTURE(arguments.front());
    std::vector<std::string> command{script()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Finished told = run_program(command);
    CHECK(told.exit_code == 2);
    CHECK(contains(told.errors, "other_scenes.sh: "));
  }
}

}  // namespace puck
