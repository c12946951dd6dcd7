// tools/more_games.sh: with the real programs, and with programs that say or fail as those might.
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"
#include "tests/system_compare/stand_ins.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

fs::path more_games() { return source_folder() / "tools/more_games.sh"; }

Finished told_by(const TemporaryFolder& folder, const std::string& evaluate,
                 const std::vector<std::string>& arguments) {
  std::vector<std::string> command{more_games(), "--programs", programs_that(folder, evaluate),
                                   "--output", folder / "out"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command);
}

bool says(const Finished& told, const std::string& text) {
  return told.output.find(text) != std::string::npos;
}

int recordings_in(const fs::path& folder) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    count += entry.path().extension() == ".raw" ? 1 : 0;
  }
  return count;
}

// Of three games: 1, 2 and 6 px, 10, 20 and 60 %, each a tenth of that with any option more.
const std::string kFigures =
    "case $seed in 11) n=1 ;; 12) n=2 ;; *) n=6 ;; esac\n"
    "if [ $# -gt 5 ]; then n=0.$n; fi\n"
    "echo mean_px $n; echo lost_percent ${n}0; echo longest_loss_ms 4$seed\n";

}  // namespace

TEST_CASE("means have the standard error of so many games") {
  const TemporaryFolder folder;
  const Finished told = told_by(folder, kFigures, {"11-13"});
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 0);
  CHECK(says(told, "| 12 | 2.00 / 20.00 / 412 |\n"));
  CHECK(says(told, "3 games, plain"));
  // The deviations are -2, -1 and 3: √(14 / 2 / 3).
  CHECK(says(told, "default: 3.00 ± 1.53 / 30.00 ± 15.28, longest loss 413 ms\n"));
  CHECK(recordings_in(folder / "out") == 0);
}

TEST_CASE("what options change has the error of the differences, game by game") {
  const TemporaryFolder folder;
  const Finished told = told_by(folder, kFigures, {"11-13", "--", "--without", "shear"});
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 0);
  CHECK(says(told, "| 12 | 2.00 / 20.00 / 412 | 0.20 / 0.20 / 412 |\n"));
  CHECK(says(told, "--without shear: 0.30 ± 0.15 / 0.30 ± 0.15, longest loss 413 ms\n"));
  CHECK(says(told, "change: -2.70 ± 1.37 / -29.70 ± 15.12\n"));
}

TEST_CASE("one game tells no error") {
  const TemporaryFolder folder;
  const Finished told = told_by(folder, kFigures, {"12-12"});
  CHECK(told.exit_code == 0);
  CHECK(says(told, "default: 2.00 ± ? / 20.00 ± ?, longest loss 412 ms\n"));
}

TEST_CASE("a game that fails or cannot be scored has no part in the means") {
  for (const char* failure : {"exit 1", "echo mean_px -; exit 0"}) {
    CAPTURE(failure);
    const TemporaryFolder folder;
    const Finished told = told_by(
        folder, "if [ $seed = 13 ]; then " + std::string(failure) + "; fi\n" + kFigures, {"11-13"});
    CHECK(told.exit_code == 1);
    CHECK(told.errors.find("seed 13 failed") != std::string::npos);
    CHECK_FALSE(says(told, "| 13 |"));
    CHECK(says(told, "default: 1.50 ± 0.50 / 15.00 ± 5.00, longest loss 412 ms\n"));
  }
}

TEST_CASE("kept recordings are used again, and those of another scene are not") {
  const TemporaryFolder folder;
  const fs::path scene = folder / "scene.toml";
  write_text(scene, "[game]\n");
  const std::vector<std::string> arguments{"11-12", "--scene", scene, "--keep"};
  CHECK(told_by(folder, kFigures, arguments).exit_code == 0);
  CHECK(recordings_in(folder / "out") == 2);

  // What the simulator would write is another seed, which no game has.
  for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
    if (entry.path().filename() == "11.raw") write_text(entry.path(), "12\n");
  }
  CHECK(says(told_by(folder, kFigures, arguments), "| 11 | 2.00 / 20.00 / 412 |\n"));

  write_text(scene, "[game]\n# changed\n");
  CHECK(says(told_by(folder, kFigures, arguments), "| 11 | 1.00 / 10.00 / 411 |\n"));
}

TEST_CASE("a real game is played in a real scene, with an ingredient and without it") {
  const TemporaryFolder folder;
  const Finished told = run_program(
      {more_games(), "11-11", "--scene", source_folder() / "tools/compare/scenes/rests.toml",
       "--seconds", "1", "--programs", required_environment("PUCK_BIN_DIR"), "--output",
       folder / "out", "--", "--without", "lag"},
      {}, std::chrono::minutes(4));
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 0);
  CHECK(says(told, "1 game, rests"));
  CHECK(says(told, "\n--without lag: "));
}

TEST_CASE("games that are asked for in the wrong way are refused before any is played") {
  const Finished help = run_program({more_games(), "--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.output.find("--size-model FILE") != std::string::npos);

  const TemporaryFolder folder;
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"11"},
                                             {"13-11"},
                                             {"11-x"},
                                             {"11-12", "13-14"},
                                             {"11-12", "--seconds", "1.2.3"},
                                             {"11-12", "--jobs", "0"},
                                             {"11-12", "--scene", "no_such_scene.toml"},
                                             {"11-12", "--size-model", "no_such_model.toml"},
                                             {"11-12", "--no-such-option"},
                                             {"11-12", "--"}}) {
    CAPTURE(arguments.size());
    const Finished told = told_by(folder, kFigures, arguments);
    CHECK(told.exit_code == 2);
    CHECK(told.errors.find("more_games.sh: ") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(folder / "out"));
}

}  // namespace puck
