// tools/real.sh: with the real programs on a small folder of recordings, and with one that fails.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/child_process.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

// A folder like that of the real recordings, with a simulated game in place of one of them.
class SmallRecordings {
 public:
  SmallRecordings() {
    const fs::path base = folder_ / "recordings" / "second_simulator" / "still_faint_6_m_s";
    fs::create_directories(base.parent_path());
    const Finished made = run_program({programs() / "puck-simulate", "--output", base.string(),
                                       "--seconds", "1.5", "--seed", "3"});
    REQUIRE(made.exit_code == 0);
    // The script must not find the size model that puck-simulate writes beside it.
    fs::remove(base.string() + ".toml");
  }

  Finished run(const fs::path& programs, const std::string& contestants) const {
    return run_program({source_folder() / "tools/real.sh", "--programs", programs, "--recordings",
                        folder_ / "recordings", "--output", folder_ / "out", "--json", json(),
                        "--only", contestants},
                       {}, std::chrono::minutes(3));
  }
  fs::path json() const { return folder_ / "real.json"; }
  static fs::path programs() { return required_environment("PUCK_BIN_DIR"); }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("each recording has a row for each tracker, and absent or unreadable ones are named") {
  const SmallRecordings small;
  write_text(small.folder() / "recordings" / "flight.xyz", "?");
  const Finished told = small.run(SmallRecordings::programs(), "default,cluster");
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 0);
  const std::string row = "| second simulator: still_faint_6_m_s | ";
  CHECK(contains(told.output, row + "default | "));
  CHECK(contains(told.output, row + "cluster | "));
  CHECK_FALSE(contains(told.output, "real ball"));
  CHECK(contains(told.errors, "real_ball/bouncing_ball_atis_304x240.yarp.log"));
  CHECK(contains(told.errors, "in no row: flight.xyz"));
  std::vector<std::string> contestants;
  for (const auto& run : nlohmann::json::parse(read_text(small.json()))) {
    if (run["run"] != "still_faint_6_m_s") continue;
    CHECK(run["recording"] == "second simulator: still_faint_6_m_s");
    contestants.push_back(run["contestant"]);
  }
  std::sort(contestants.begin(), contestants.end());
  CHECK(contestants == std::vector<std::string>{"cluster", "default"});
}

TEST_CASE("a run that fails has no row and does not affect others") {
  const SmallRecordings small;
  const fs::path programs = small.folder() / "programs";
  fs::create_directory(programs);
  const std::string real = SmallRecordings::programs().string();
  for (const char* name : {"puck-calibrate", "puck-evaluate"}) {
    write_text(programs / name,
               "#!/bin/sh\ncase \"$*\" in *cluster*) echo no luck >&2; exit 1 ;; esac\nexec " +
                   real + "/" + name + " \"$@\"\n");
    fs::permissions(programs / name, fs::perms::owner_all);
  }
  const Finished told = small.run(programs, "default,cluster");
  INFO(told.output, told.errors);
  CHECK(told.exit_code == 1);
  CHECK(contains(told.output, "| default | "));
  CHECK_FALSE(contains(told.output, "| cluster | "));
  CHECK(contains(told.errors, "no luck"));
}

TEST_CASE("a folder without recordings and an unknown tracker are refused") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command{source_folder() / "tools/real.sh", "--programs",
                                     SmallRecordings::programs()};
    command.insert(command.end(), options.begin(), options.end());
    const Finished told = run_program(command);
    CHECK(told.exit_code == 2);
    return told.errors;
  };
  CHECK(contains(refusal({"--recordings", folder / "nowhere"}), "no folder "));
  CHECK(contains(refusal({"--recordings", folder.path(), "--output", folder / "out"}),
                 "none of the recordings is in "));
  CHECK(contains(refusal({"--only", "best"}), "got 'best'"));
}

}  // namespace puck
