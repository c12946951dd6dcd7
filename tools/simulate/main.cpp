#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "common/recording/recording.h"
#include "tools/command_line/number_range.h"
#include "tools/simulate/recording.h"
#include "tools/simulate/sensor_plots.h"
#include "tools/simulate/simulate_settings.h"

namespace puck {
namespace {

void print(const SimulateSettings& settings, const RecordingSummary& summary) {
  const double events = static_cast<double>(summary.events);
  std::printf("%s: %lld events in %.3f s, %.0f kev/s\n", settings.output.c_str(),
              static_cast<long long>(summary.events), summary.seconds,
              events / summary.seconds * 1e-3);
  if (summary.lost > 0) {
    std::printf("%lld more events were lost at the sensor's readout\n",
                static_cast<long long>(summary.lost));
  }
  std::printf("shots %d, saves %d, goals against %d, goals for %d\n", summary.counts.shots,
              summary.counts.saves, summary.counts.goals_against, summary.counts.goals_for);
  std::printf("%d marks%s; took %.1f s, %.2f times the played time\n", summary.marks,
              summary.has_size_model ? "" : " (too few for a size model)", summary.took_s,
              summary.took_s / summary.seconds);
}

int run(int argc, char** argv) {
  SimulateSettings settings;
  settings.command = std::filesystem::path(argv[0]).filename();
  for (int i = 1; i < argc; ++i) settings.command += std::string(" ") + argv[i];

  CLI::App app("Writes an event recording of a simulated game, with exact truth.", "puck-simulate");
  app.set_version_flag("--version", PUCK_VERSION);
  app.add_option("--output", settings.output,
                 "base name: writes BASE.raw (or the format's ending), BASE.truth.csv, "
                 "BASE.annotations.csv, BASE.toml");
  app.add_option("--sensor-checks", settings.sensor_checks,
                 "folder: measures the simulated sensor with the methods for real ones, and "
                 "writes plots there");
  app.add_option("--scene", settings.scene,
                 "TOML file of the scene; config/scene.toml has every key");
  app.add_option("--seed", settings.seed, "The same seed gives the same game and events")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1'000'000'000'000}));
  app.add_option("--seconds", settings.seconds, "Length of the recording")
      ->check(number_range(0.001, 3600))
      ->capture_default_str();
  app.add_flag("--moving", settings.moving, "The camera's head turns, as on a robot that plays");
  app.add_option("--format", settings.format, "Format of the event file")
      ->check(CLI::IsMember(written_format_names()))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
    if (settings.output.empty() && settings.sensor_checks.empty()) {
      throw CLI::RequiredError("--output");
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  try {
    const SimulationParams params = simulation_params_of(settings);
    if (!settings.sensor_checks.empty()) {
      write_sensor_plots({.sensor = params.sensor, .light = params.light, .seed = params.seed},
                         settings.sensor_checks);
    }
    if (!settings.output.empty()) print(settings, record(settings, params));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-simulate: %s\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) { return puck::run(argc, argv); }
