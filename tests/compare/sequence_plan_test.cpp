#include "tools/compare/sequence_plan.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate/simulate_settings.h"

namespace puck {
namespace {

bool runs(const Sequence& sequence, const std::string& name) {
  return std::any_of(sequence.contestants.begin(), sequence.contestants.end(),
                     [&](const Contestant& contestant) { return contestant.name == name; });
}

std::filesystem::path comparison_folder() { return source_folder() / "tools/compare"; }

}  // namespace

TEST_CASE("the whole comparison is 10 still, 10 moving and 5 of each hard set") {
  int still = 0;
  int moving = 0;
  int hard = 0;
  for (const Sequence& sequence : plan_sequences({})) {
    still += sequence.set.name == "still";
    moving += sequence.set.name == "moving";
    hard += sequence.set.is_hard;
    CHECK(sequence.seconds == (sequence.set.is_hard ? 10 : 30));
  }
  CHECK(still == 10);
  CHECK(moving == 10);
  CHECK(hard == 5 * (static_cast<int>(sequence_sets().size()) - 2));
}

TEST_CASE("no seed is used twice, and no development seed is used for testing") {
  for (const int sequences : {10, PlanOptions::kMostSequences}) {
    PlanOptions options;
    options.sequences = sequences;
    std::set<int> seeds;
    for (const Sequence& sequence : plan_sequences(options)) {
      CHECK(sequence.seed > 1000);
      CHECK(seeds.insert(sequence.seed).second);
    }
  }
  CHECK(calibration_sequence().seed <= 99);
  CHECK(latency_sequence({}, 1).seed <= 99);
}

TEST_CASE("the quick form has every set, shortened") {
  const PlanOptions quick{.sequences = 2, .seconds = 5};
  std::set<std::string> sets;
  for (const Sequence& sequence : plan_sequences(quick)) {
    sets.insert(sequence.set.name);
    CHECK(sequence.seconds == (sequence.set.is_hard ? 2 : 5));
  }
  CHECK(sets.size() == sequence_sets().size());
  const SequenceSet hard = set_of(sequence_sets(), "rests");
  CHECK(seconds_of(hard, {.sequences = 1, .seconds = 1}) == 1);
  CHECK(sequences_of(hard, quick) == 1);
}

TEST_CASE("selected trackers run on every set, and no others") {
  const PlanOptions options{.only = {"default", "cluster"}};
  const std::vector<Sequence> sequences = plan_sequences(options);
  CHECK(sequences.size() == plan_sequences({}).size());
  for (const Sequence& sequence : sequences) {
    CHECK(sequence.contestants.size() == 2);
    CHECK(runs(sequence, "default"));
    CHECK(runs(sequence, "cluster"));
  }
  CHECK(latency_sequence(options, 5).contestants.size() == 2);
}

TEST_CASE("other surfaces run only where they are named") {
  for (const Sequence& sequence : plan_sequences({})) CHECK(!runs(sequence, "correlation-tos"));
  CHECK(latency_sequence({}, 5).contestants.size() == 6);
  for (const Sequence& sequence : plan_sequences({.only = {"correlation", "correlation-tos"}})) {
    REQUIRE(sequence.contestants.size() == 2);
    CHECK(sequence.contestants[0].options ==
          std::vector<std::string>{"--preset", "correlation", "--surface", "tos"});
  }
}

TEST_CASE("all presets run on every set, the particle filter where it is affordable") {
  for (const Sequence& sequence : plan_sequences({})) {
    for (const char* name : {"paper", "reference", "correlation", "default", "cluster"}) {
      CHECK(runs(sequence, name));
    }
    CHECK(runs(sequence, "particle-filter") == !sequence.set.is_hard);
  }
}

TEST_CASE("every scene file exists and is playable") {
  const std::filesystem::path scenes = comparison_folder() / "scenes";
  for (const SequenceSet& set : sequence_sets()) {
    if (set.scene.empty()) continue;
    CAPTURE(set.scene);
    CHECK_NOTHROW(simulation_params_of({.scene = scenes / set.scene}));
  }
  CHECK_THROWS_AS(set_of(sequence_sets(), "no such set"), std::invalid_argument);
}

TEST_CASE("every scene of tools/other_scenes.sh has a name and is playable") {
  int scenes = 0;
  const std::filesystem::path folder = comparison_folder() / "other_scenes";
  for (const auto& scene : std::filesystem::directory_iterator(folder)) {
    CAPTURE(scene.path());
    ++scenes;
    CHECK_NOTHROW(simulation_params_of({.scene = scene.path()}));
    CHECK(read_text(scene.path()).starts_with("# "));
  }
  CHECK(scenes > 20);
}

}  // namespace puck
