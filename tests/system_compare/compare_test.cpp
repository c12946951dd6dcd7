// The paper's comparison in small: puck-compare with all programs that it runs.
#include <chrono>
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

const std::vector<std::string> kSets{"still",
                                     "moving",
                                     "low-contrast-still",
                                     "low-contrast-moving",
                                     "logos-moving",
                                     "fast-still",
                                     "fast-moving",
                                     "dim",
                                     "flicker",
                                     "hot-pixels",
                                     "rests",
                                     "occlusion",
                                     "goals",
                                     "leaves-image",
                                     "second-puck",
                                     "noisy",
                                     "printed"};

// Returns its progress output.
std::string compare(const TemporaryFolder& folder) {
  const std::vector<std::string> command{program_path("puck-compare"),
                                         "--sequences",
                                         "1",
                                         "--seconds",
                                         "2",
                                         "--scenes",
                                         source_folder() / "tools/compare/scenes",
                                         "--output",
                                         folder / "out"};
  ChildProcess child(command, {.output = folder / "output.txt", .errors = folder / "errors.txt"});
  const auto exit_code = child.wait_for(std::chrono::minutes(15));
  INFO(read_text(folder / "errors.txt"));
  REQUIRE(exit_code == 0);
  return read_text(folder / "output.txt");
}

}  // namespace

TEST_CASE("the comparison runs every tracker on every set, and again from its stored results") {
  const TemporaryFolder folder;
  const std::string told = compare(folder);
  CHECK(told.find("still 1001, default: ") != std::string::npos);
  CHECK(told.find(" left] ") != std::string::npos);

  const Json json = Json::parse(read_text(folder / "out/comparison.json"));
  for (const std::string& set : kSets) {
    CAPTURE(set);
    for (const char* contestant : {"paper", "reference", "correlation", "default", "cluster"}) {
      CAPTURE(contestant);
      const Json& result = json.at("sets").at(set).at("contestants").at(contestant);
      CHECK(result.at("sequences") == 1);
      CHECK(result.at("estimates") > 0);
      CHECK(result.at("mean_px").is_number());
      CHECK(result.at("cpu_us_per_ms") > 0.0);
    }
  }
  CHECK(json["sets"]["moving"]["contestants"]["particle-filter"]["mean_px"].is_number());
  for (const auto& contestant : json.at("latency").items()) {
    CAPTURE(contestant.key());
    CHECK(contestant.value().at(0).at("latency_p50_us").is_number());
  }

  // In any two seconds: ours is finer than the blob and never loses an easy puck.
  const Json& still = json["sets"]["still"]["contestants"];
  CHECK(still["default"]["lost_percent"] < 2.0);
  CHECK(still["default"]["mean_px"] < 1.0);
  CHECK(still["default"]["mean_px"] < still["cluster"]["mean_px"]);

  for (const char* figure :
       {"errors-still", "errors-moving", "within-still", "within-moving", "trajectories-still",
        "trajectories-moving", "latency", "hard", "score"}) {
    CAPTURE(figure);
    CHECK(std::filesystem::file_size(folder / "out" / (std::string(figure) + ".png")) > 5'000);
  }
  CHECK(std::filesystem::is_empty(folder / "out/recordings"));

  const std::string again = compare(folder);
  CHECK(again.find(" left] ") == std::string::npos);
  CHECK(Json::parse(read_text(folder / "out/comparison.json")) == json);
}

TEST_CASE("the script prints its usage") {
  const Finished help = run_program({source_folder() / "tools/compare.sh", "--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.output.find("--sequences N") != std::string::npos);
  CHECK(help.output.find("Seeds: 1 to 99 are for development") != std::string::npos);
}

}  // namespace puck
