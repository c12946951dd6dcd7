#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/charts/draw_charts.h"
#include "tools/command_line/number_range.h"
#include "tools/command_line/run_tool.h"
#include "tools/compare/experiment.h"
#include "tools/compare/program.h"
#include "tools/compare/report.h"

namespace puck {
namespace {

constexpr double kLongestLatencySeconds = 5;

struct Options {
  PlanOptions plan;
  ExperimentSettings experiment{
      .programs = {}, .scenes = "tools/compare/scenes", .output = "build/compare"};
};

void compare(const Options& options) {
  std::filesystem::create_directories(options.experiment.output);
  std::printf("%s\n", seeds_text(options.plan).c_str());
  Experiment experiment(options.experiment);
  const Comparison comparison(experiment.run(plan_sequences(options.plan)));
  // After all other runs: a run in parallel would add to the latency.
  const Comparison latency(
      experiment.run({latency_sequence(options.plan, kLongestLatencySeconds)}));

  const ComparisonReport report{options.plan, comparison, latency};
  write_report(report, options.experiment.output);
  std::printf("\n%s\n", read_whole_file(options.experiment.output / "comparison.txt").c_str());
  std::fflush(stdout);
  draw_charts("compare", {options.experiment.output});
  std::printf("table, JSON and figures: %s\n", options.experiment.output.c_str());
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) {
  CLI::App app(
      "Makes simulated sequences, runs every tracker over them and reports their accuracy. See "
      "tools/compare.sh, which builds it and runs it.",
      "puck-compare");
  puck::Options options;
  std::vector<std::string> names;
  for (const puck::Contestant& contestant : puck::contestants()) names.push_back(contestant.name);
  options.experiment.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  options.experiment.jobs = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
  app.add_option("--sequences", options.plan.sequences,
                 "of the still and of the moving camera each")
      ->check(CLI::Range(1, puck::PlanOptions::kMostSequences))
      ->capture_default_str();
  app.add_option("--seconds", options.plan.seconds,
                 "of each of them; hard ones are a third as long")
      ->check(puck::number_range(1, 600))
      ->capture_default_str();
  app.add_option("--only", options.plan.only,
                 "these trackers alone; correlation-tos and its like run only then")
      ->check(CLI::IsMember(names))
      ->delimiter(',');
  app.add_option("--scoring", options.plan.scoring,
                 "ours, or paper: as the paper's authors score (see puck-evaluate)")
      ->check(CLI::IsMember({"ours", "paper"}))
      ->capture_default_str();
  app.add_option("--output", options.experiment.output, "folder")
      ->take_last()
      ->capture_default_str();
  app.add_option("--jobs", options.experiment.jobs, "sequences at a time")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--scenes", options.experiment.scenes, "folder of the hard scenes")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  app.add_option("--programs", options.experiment.programs,
                 "folder of puck-simulate, puck-calibrate and puck-evaluate")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  app.add_flag("--keep", options.experiment.keep_recordings, "do not delete the recordings");
  return puck::run_tool(app, argc, argv, "puck-compare", [&] {
    puck::compare(options);
    return 0;
  });
}
