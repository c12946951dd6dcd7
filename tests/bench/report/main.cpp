#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "tests/bench/report/benchmark_output.h"
#include "tests/bench/report/figures.h"

namespace {

struct Options {
  std::filesystem::path benchmarks;
  std::filesystem::path live;
  std::filesystem::path json;
};

// 0 when everything was measured, whether its bar is met or not; else 1.
int report(const Options& options) {
  const puck::BenchmarkOutput output = puck::read_benchmark_output(options.benchmarks);
  puck::BenchFigures figures = puck::figures_of(output);
  if (!options.live.empty()) puck::add_flat_json(options.live, figures);
  puck::print(figures);
  if (!options.json.empty()) puck::write_json(figures, options.json);
  for (const std::string& failure : output.failures) {
    std::fprintf(stderr, "puck-bench-report: could not run: %s\n", failure.c_str());
  }
  const auto missing = puck::missing_keys(figures);
  for (const std::string& key : missing) {
    std::fprintf(stderr, "puck-bench-report: not measured: %s\n", key.c_str());
  }
  return output.failures.empty() && missing.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Makes a table and JSON of what the benchmarks measured.", "puck-bench-report");
  Options options;
  app.add_option("BENCHMARKS", options.benchmarks, "what puck-bench --benchmark_out wrote")
      ->required();
  app.add_option("--live", options.live, "what puck-bench-live --json wrote");
  app.add_option("--json", options.json, "write the figures here");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return report(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-bench-report: %s\n", error.what());
    return 1;
  }
}
