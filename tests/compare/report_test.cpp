#include "tools/compare/report.h"

#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "tools/compare/program.h"
#include "tools/compare/report_json.h"
#include "tools/compare/sequence_plan.h"

namespace puck {
namespace {

using Json = nlohmann::json;

// A folder with the results of runs.
class Runs {
 public:
  void add(const std::string& set, int seed, const std::string& contestant, const Json& figures) {
    const std::string name = set + std::to_string(seed) + contestant;
    std::filesystem::create_directory(folder_ / name);
    write_text(folder_ / name / "figures.json", figures.dump());
    results_.results.push_back({set, seed, contestant, folder_ / name});
  }
  Comparison comparison() const { return Comparison(results_); }

 private:
  TemporaryFolder folder_;
  ExperimentResults results_;
};

Json figures(int ticks, double mean_px, double lost_percent) {
  return {{"estimates", ticks},           {"mean_px", mean_px},
          {"lost_percent", lost_percent}, {"longest_loss_ms", lost_percent * 10},
          {"time_to_first_track_ms", 5},  {"duration_s", 1},
          {"cpu_us_per_ms", 40},          {"nees_mean", nullptr}};
}

const GoalResult& goal(const std::vector<GoalResult>& goals, const std::string& title) {
  for (const GoalResult& result : goals) {
    if (result.title == title) return result;
  }
  throw std::runtime_error("no goal is called " + title);
}

}  // namespace

TEST_CASE("a summary weights its sequences by their ticks and keeps the worst") {
  Runs runs;
  runs.add("still", 1002, "default", figures(3000, 0.4, 1));
  runs.add("still", 1001, "default", figures(1000, 0.2, 0));
  runs.add("moving", 1101, "default", figures(1000, 9, 50));
  runs.add("still", 1001, "paper", figures(1000, 7, 50));
  const Summary summary = runs.comparison().summary("still", "default");
  CHECK(summary.sequences == 2);
  CHECK(summary.ticks == 4000);
  CHECK(*summary.mean_px == doctest::Approx(0.35));
  CHECK(*summary.median_mean_px == doctest::Approx(0.2));
  CHECK(*summary.worst_mean_px == doctest::Approx(0.4));
  CHECK(*summary.lost_percent == doctest::Approx(0.75));
  CHECK(*summary.mean_px_standard_error == doctest::Approx(0.1));
  CHECK(*summary.lost_percent_standard_error == doctest::Approx(0.5));
  CHECK(*summary.longest_loss_ms == doctest::Approx(10));
  CHECK(*summary.time_to_first_track_ms == 5);
  CHECK_FALSE(summary.nees_mean.has_value());
  CHECK(runs.comparison().runs({"still"}, "default").front()->result().seed == 1001);
}

TEST_CASE("by the paper's rules the deviation covers all rows, and nothing is lost") {
  Runs runs;
  Json one{{"estimates", 100}, {"mean_px", 1}, {"std_px", 0}, {"lost_percent", nullptr}};
  Json other{{"estimates", 100}, {"mean_px", 3}, {"std_px", 0}, {"lost_percent", nullptr}};
  runs.add("still", 1001, "default", one);
  runs.add("still", 1002, "default", other);
  const Summary summary = runs.comparison().summary("still", "default");
  CHECK(*summary.mean_px == doctest::Approx(2));
  CHECK(*summary.std_px == doctest::Approx(1));
  CHECK_FALSE(summary.lost_percent.has_value());
  CHECK_FALSE(summary.said_and_wrong_percent.has_value());
  PlanOptions plan;
  plan.scoring = "paper";
  for (const Sequence& sequence : plan_sequences(plan)) {
    for (const Contestant& contestant : sequence.contestants) {
      REQUIRE(contestant.options.size() >= 2);
      CHECK(contestant.options.back() == "paper");
    }
  }
}

TEST_CASE(
    "the standard error of a mean comes from differences between sequences, of at least two") {
  Runs runs;
  for (int i = 0; i < 4; ++i) runs.add("still", 1001 + i, "default", figures(1000, 1 + i, 2));
  runs.add("moving", 1101, "default", figures(1000, 1, 2));
  const Summary four = runs.comparison().summary("still", "default");
  // The deviation of 1, 2, 3 and 4 over the root of four.
  CHECK(*four.mean_px_standard_error == doctest::Approx(std::sqrt(5.0 / 3) / 2));
  CHECK(*four.lost_percent_standard_error == 0);
  const Summary one = runs.comparison().summary("moving", "default");
  CHECK_FALSE(one.mean_px_standard_error.has_value());
  CHECK_FALSE(one.lost_percent_standard_error.has_value());
}

TEST_CASE("a puck never tracked in one sequence has no time to its first track") {
  Runs runs;
  Json never = figures(1000, 100, 100);
  never["time_to_first_track_ms"] = nullptr;
  runs.add("still", 1001, "default", figures(1000, 0.2, 0));
  runs.add("still", 1002, "default", never);
  CHECK_FALSE(runs.comparison().summary("still", "default").time_to_first_track_ms.has_value());
}

TEST_CASE("goals are reached at their limits, missed beyond them and without a run") {
  Runs runs;
  runs.add("still", 1001, "default", figures(1000, 0.25, 0.1));
  runs.add("still", 1001, "correlation", figures(1000, 0.36, 0));
  runs.add("still", 1001, "reference", figures(1000, 9, 9));
  const auto results = check_goals(runs.comparison());
  const GoalResult& mean = goal(results, "still: mean error, px");
  CHECK(mean.by_default.reached() == true);
  CHECK(mean.correlation.reached() == false);
  CHECK(mean.reference.measured == 9);
  CHECK_FALSE(mean.reference.reached().has_value());
  CHECK(goal(results, "still: lost, %").by_default.reached() == false);
  CHECK(goal(results, "still: CPU time a millisecond, us").by_default.reached() == true);
  CHECK(goal(results, "moving: mean error, px").by_default.reached() == false);
  GoalCell share{99, 98, true};
  CHECK(share.reached() == true);
  share.measured = 97;
  CHECK(share.reached() == false);
}

TEST_CASE("every goal names existing sets") {
  for (const Goal& goal : goals()) {
    CAPTURE(goal.title);
    CHECK_FALSE(goal.sets.empty());
    for (const std::string& set : goal.sets) CHECK_NOTHROW(set_of(sequence_sets(), set));
  }
}

TEST_CASE("the report names every set and every seed, in text and JSON") {
  Runs runs;
  runs.add("still", 1001, "default", figures(1000, 0.25, 0.1));
  const Comparison comparison = runs.comparison();
  const Comparison latency((ExperimentResults()));
  const ComparisonReport report{{}, comparison, latency};
  const TemporaryFolder folder;
  write_report(report, folder.path());

  const std::string text = read_text(folder / "comparison.txt");
  const std::string markdown = read_text(folder / "comparison.md");
  for (const SequenceSet& set : sequence_sets()) {
    CAPTURE(set.title);
    CHECK(text.find(set.title) != std::string::npos);
    CHECK(markdown.find("### " + set.title) != std::string::npos);
  }
  CHECK(text.find("seeds 1001 to 1010") != std::string::npos);

  const Json json = Json::parse(read_text(folder / "comparison.json"));
  CHECK(json["sets"]["still"]["contestants"]["default"]["mean_px"] == 0.25);
  CHECK(json["sets"]["still"]["contestants"]["default"]["runs"][0]["seed"] == 1001);
  CHECK(json["goals"].size() == goals().size());
}

TEST_CASE("the report has standard errors beside mean and lost") {
  Runs runs;
  runs.add("still", 1001, "default", figures(1000, 0.25, 1));
  runs.add("still", 1002, "default", figures(1000, 0.75, 3));
  const Comparison comparison = runs.comparison();
  const Comparison latency((ExperimentResults()));
  const ComparisonReport report{{}, comparison, latency};
  const TemporaryFolder folder;
  write_report(report, folder.path());
  const Json json = Json::parse(read_text(folder / "comparison.json"));
  const Json& still = json.at("sets").at("still").at("contestants").at("default");
  CHECK(still.at("mean_px_standard_error") == 0.25);
  CHECK(still.at("lost_percent_standard_error") == 1);
  const std::string markdown = read_text(folder / "comparison.md");
  CHECK(markdown.find("|  | mean px | +- | std px | median seq. |") != std::string::npos);
  CHECK(markdown.find("| lost % | +- |") != std::string::npos);
  CHECK(markdown.find("| default | 0.500 | 0.250 |") != std::string::npos);
  CHECK(markdown.find("| 2.00 | 1.00 |") != std::string::npos);
}

TEST_CASE("a table is aligned, and a row of the wrong length is refused") {
  TextTable table("Title", {"", "px", "%"});
  table.add({"default", number_text(0.126, 2), number_text({}, 1)});
  CHECK(table.text() == "Title\n             px  %\n  default  0.13  -\n");
  CHECK(table.markdown() ==
        "### Title\n\n|  | px | % |\n|---|---:|---:|\n| default | 0.13 | - |\n");
  CHECK_THROWS_AS(table.add({"default"}), std::invalid_argument);
}

TEST_CASE("a failing program is reported with its output") {
  const TemporaryFolder folder;
  CHECK(run_or_throw({"/bin/true"}, folder.path()) >= 0);
  std::string message;
  try {
    run_or_throw({"/bin/sh", "-c", "echo no such seed >&2; exit 3"}, folder.path());
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  CHECK(message.find("ended with exit code 3 and printed:\nno such seed") != std::string::npos);
  CHECK_THROWS_AS(run_or_throw({"/no/such/program"}, folder.path()), std::runtime_error);
}

}  // namespace puck
