// tools/more_games.sh: with the real programs, and with stand-ins for their output or failure.
#include <chrono>
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

fs::path more_games() { return source_folder() / "tools/more_games.sh"; }

Finished told_by(const TemporaryFolder& folder, const std::string& evaluate,
                 const std::vector<std::string>& arguments, const std::string& simulate = "") {
  std::vector<std::string> command{more_games(), "--programs",
                                   programs_that(folder, evaluate, simulate), "--output",
                                   folder / "out"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command);
}

int recordings_in(const fs::path& folder) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    count += entry.path().extension() == ".raw" ? 1 : 0;
  }
  return count;
}

// Figures of three games: 1, 2 and 6 px, 10, 20 and 60 %, 411 to 413 ms. With any further option, a
// tenth of the px, a twentieth of the %, and 511 to 513 ms.
const std::string kFigures =
    "case $seed in 11) n=1 lost=0.5 ;; 12) n=2 lost=1 ;; *) n=6 lost=3 ;; esac\n"
    "if [ $# -gt 5 ]; then echo mean_px 0.$n; echo lost_percent $lost; echo longest_loss_ms "
    "5$seed\n"
    "else echo mean_px $n; echo lost_percent ${n}0; echo longest_loss_ms 4$seed; fi\n";

}  // namespace

TEST_CASE("means have the standard error of their number of games") {
  const TemporaryFolder folder;
  const Finished told = told_by(folder, kFigures, {"11-13"});
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 0);
  CHECK(contains(told.output, "| 12 | 2.000 / 20.000 / 412 |\n"));
  CHECK(contains(told.output, "3 games of 10 s, plain, mean"));
  // The deviations are -2, -1 and 3: √(14 / 2 / 3).
  CHECK(contains(told.output, "default: 3.000 ± 1.528 / 30.000 ± 15.275, longest loss 413 ms\n"));
  CHECK(recordings_in(folder / "out") == 0);
}

TEST_CASE("the effect of options has the standard error of the differences, game by game") {
  const TemporaryFolder folder;
  const Finished told = told_by(folder, kFigures, {"11-13", "--", "--option", "SEED"});
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 0);
  CHECK(contains(told.output, "| 12 | 2.000 / 20.000 / 412 | 0.200 / 1.000 / 512 |\n"));
  CHECK(
      contains(told.output, "--option SEED: 0.300 ± 0.153 / 1.500 ± 0.764, longest loss 513 ms\n"));
  CHECK(contains(told.output, "change: -2.700 ± 1.375 / -28.500 ± 14.511\n"));
}

TEST_CASE("a single game gives no standard error") {
  const TemporaryFolder folder;
  const Finished told = told_by(folder, kFigures, {"12-12"});
  CHECK(told.exit_code == 0);
  CHECK(contains(told.output, "1 game of 10 s, plain, mean"));
  CHECK(contains(told.output, "default: 2.000 ± ? / 20.000 ± ?, longest loss 412 ms\n"));
}

TEST_CASE("games are played and tracked with the requested options") {
  const TemporaryFolder folder;
  write_text(folder / "scene.toml", "");
  write_text(folder / "size.toml", "");
  // 3 px, if all options arrived.
  const Finished told = told_by(
      folder,
      "game=$(cat \"$3\")\nn=0\n"
      "case $game in *scene.toml*) n=$((n + 1)) ;; esac\n"
      "case $game in *--moving*) n=$((n + 1)) ;; esac\n"
      "case \"$game $5 $6 $7\" in *'--seconds 4'*'/size.toml --seed a b') n=$((n + 1)) ;; esac\n"
      "echo mean_px $n; echo lost_percent 0; echo longest_loss_ms 0\n",
      {"11-11", "--scene", folder / "scene.toml", "--moving", "--seconds", "4", "--size-model",
       folder / "size.toml", "--", "--seed", "a b"});
  INFO(told.output, told.errors);
  CHECK(contains(told.output, "1 game of 4 s, scene, moving, mean"));
  CHECK(contains(told.output, "default: 2.000 ± ?"));
  CHECK(contains(told.output, "--seed a b: 3.000 ± ?"));
}

TEST_CASE("a game that fails or cannot be scored is left out of the means") {
  const std::string thirteenth = "if [ $seed = 13 ]; then ";
  struct Failure {
    std::string evaluate;
    std::string simulate;
  };
  for (const Failure& failure : {Failure{thirteenth + "exit 1; fi\n" + kFigures, ""},
                                 Failure{thirteenth + "echo mean_px -; exit; fi\n" + kFigures, ""},
                                 Failure{kFigures + thirteenth + "exit 1; fi\n", ""},
                                 Failure{kFigures, thirteenth + "exit 1; fi\n"}}) {
    CAPTURE(failure.evaluate);
    CAPTURE(failure.simulate);
    const TemporaryFolder folder;
    const Finished told = told_by(folder, failure.evaluate, {"11-13"}, failure.simulate);
    CHECK(told.exit_code == 1);
    CHECK(contains(told.errors, "seed 13 failed"));
    CHECK_FALSE(contains(told.output, "| 13 |"));
    CHECK(contains(told.output, "default: 1.500 ± 0.500 / 15.000 ± 5.000, longest loss 412 ms\n"));
  }
}

TEST_CASE("a game that fails with the options alone is left out, and so is its earlier run") {
  const TemporaryFolder folder;
  CHECK(told_by(folder, kFigures, {"11-13", "--keep"}).exit_code == 0);
  const Finished told = told_by(folder, "if [ $seed$# = 136 ]; then exit 1; fi\n" + kFigures,
                                {"11-13", "--", "--new-option"});
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 1);
  CHECK_FALSE(contains(told.output, "| 13 |"));
  CHECK(contains(told.output, "default: 1.500 ± 0.500 /"));
  CHECK(contains(told.output, "--new-option: 0.150 ± 0.050 /"));
}

TEST_CASE("kept recordings are reused; those of another scene are not") {
  const TemporaryFolder folder;
  const fs::path scene = folder / "scene.toml";
  write_text(scene, "[game]\n");
  const std::vector<std::string> arguments{"11-12", "--scene", scene};
  std::vector<std::string> keeping = arguments;
  keeping.emplace_back("--keep");
  CHECK(told_by(folder, kFigures, keeping, "exit 1\n").exit_code == 1);
  CHECK(recordings_in(folder / "out") == 0);
  CHECK(told_by(folder, kFigures, keeping).exit_code == 0);
  CHECK(recordings_in(folder / "out") == 2);

  // The simulator would write another seed.
  for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
    if (entry.path().filename() == "11.raw") write_text(entry.path(), "12\n");
  }
  CHECK(contains(told_by(folder, kFigures, arguments).output, "| 11 | 2.000 / 20.000 / 412 |\n"));
  CHECK(recordings_in(folder / "out") == 2);

  CHECK(contains(told_by(folder, kFigures, arguments, "# another simulator\n").output,
                 "| 11 | 1.000 /"));
  write_text(scene, "[game]\n# changed\n");
  CHECK(contains(told_by(folder, kFigures, arguments).output, "| 11 | 1.000 /"));
  CHECK(recordings_in(folder / "out") == 2);
}

TEST_CASE("a real game is played in a real scene, with preset default and another") {
  const TemporaryFolder folder;
  const Finished told = run_program(
      {more_games(), "11-11", "--scene", source_folder() / "tools/compare/scenes/rests.toml",
       "--seconds", "1", "--programs", required_environment("PUCK_BIN_DIR"), "--output",
       folder / "out", "--", "--preset", "correlation"},
      {}, std::chrono::minutes(4));
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 0);
  CHECK(contains(told.output, "1 game of 1 s, rests, mean"));
  CHECK(contains(told.output, "\n--preset correlation: "));
}

TEST_CASE("impossible requests are refused before any game is played") {
  const Finished help = run_program({more_games(), "--help"});
  CHECK(help.exit_code == 0);
  CHECK(contains(help.output, "--size-model FILE"));

  const TemporaryFolder folder;
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"11"},
                                             {"13-11"},
                                             {"11-x"},
                                             {"11-12", "13-14"},
                                             {"11-12", "--seconds", "1.2.3"},
                                             {"11-12", "--jobs", "0"},
                                             {"11-12", "--jobs", "10000"},
                                             {"11-12", "--scene", "no_such_scene.toml"},
                                             {"11-12", "--size-model", "no_such_model.toml"},
                                             {"11-12", "--no-such-option"},
                                             {"11-12", "--"},
                                             {"11-12", "--", ""}}) {
    CAPTURE(arguments.size());
    const Finished told = told_by(folder, kFigures, arguments);
    CHECK(told.exit_code == 2);
    CHECK(contains(told.errors, "more_games.sh: "));
  }
  CHECK_FALSE(fs::exists(folder / "out"));
}

}  // namespace puck
