#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/evaluation/accuracy_score.h"
#include "common/io/contour_calibration_file.h"
#include "common/io/event_reader.h"
#include "common/io/masked_reader.h"
#include "common/io/pixel_mask_file.h"
#include "common/io/size_model_file.h"
#include "common/io/truth_file.h"
#include "tools/command_line/number_range.h"
#include "tools/evaluate/log_recording.h"
#include "tools/evaluate/plots.h"
#include "tools/evaluate/report.h"
#include "tools/evaluate/runs.h"
#include "tools/evaluate/tick_file.h"
#include "tools/evaluate/tracker_setup.h"
#include "tools/evaluate/truth_cover.h"

namespace puck {
namespace {

struct Options {
  std::filesystem::path events;
  std::filesystem::path truth;
  std::filesystem::path size_model;
  std::filesystem::path hot_pixel_mask;
  std::filesystem::path json;
  std::filesystem::path csv;
  std::filesystem::path plots;
  std::string algorithm = "puck";
  std::string preset = "default";
  std::string detection_region;
  std::vector<std::string> without;
  bool roi_only = false;
  double rate_hz = 1000;
  bool real_time = false;
  bool as_fast_as_possible = false;
  EventFileOptions file;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("EVENTS", options.events,
                 "recording: Prophesee RAW (EVT2, EVT3), text, or a log of LCM")
      ->required();
  app.add_option(
      "--truth", options.truth,
      "where the puck truly was: t_us,x,y,width,height; a log of a simulated game has its own");
  app.add_option("--algorithm", options.algorithm)
      ->check(CLI::IsMember({"puck", "cluster", "particle-filter", "particle-filter-eros"}))
      ->capture_default_str();
  app.add_option("--preset", options.preset)
      ->check(CLI::IsMember({"default", "correlation", "paper", "reference"}))
      ->capture_default_str();
  app.add_option("--size-model", options.size_model, "TOML made by puck-calibrate size");
  app.add_option("--hot-pixel-mask", options.hot_pixel_mask,
                 "TOML made by puck-calibrate hot-pixels: leaves their events out");
  app.add_option("--without", options.without,
                 "an ingredient that preset default is to do without; may be given again");
  app.add_flag_callback(
      "--list-ingredients",
      [] {
        for (const ContourIngredient& ingredient : kContourIngredients) {
          std::printf("%s\n", std::string(ingredient.name).c_str());
        }
        throw CLI::Success();
      },
      "print what --without takes, and stop");
  app.add_option("--detection-region", options.detection_region, "x,y,w,h in px");
  app.add_flag("--roi-only", options.roi_only,
               "while there is a track, keep only its region of the surface up to date");
  auto* rate = app.add_option("--rate", options.rate_hz, "estimates a second of sensor time")
                   ->check(number_range(1, 1e6))
                   ->capture_default_str();
  auto* real_time = app.add_flag("--real-time", options.real_time,
                                 "play at the recording's pace: measures latency");
  auto* fast =
      app.add_flag("--as-fast-as-possible", options.as_fast_as_possible, "measures throughput");
  real_time->excludes(rate)->excludes(fast);
  fast->excludes(rate);
  app.add_option("--json", options.json, "write the figures here");
  app.add_option("--csv", options.csv, "write a row a tick here");
  app.add_option("--plots", options.plots, "write plots into this folder");
  app.add_option("--from", options.file.from, "format of EVENTS, where it does not say so itself")
      ->check(CLI::IsMember({"evt2", "evt3", "text"}));
  app.add_option("--width", options.file.sensor.width, "sensor, px, where EVENTS does not say");
  app.add_option("--height", options.file.sensor.height, "sensor, px, where EVENTS does not say");
  app.add_option("--columns", options.file.text_columns, "text: order of the columns")
      ->capture_default_str();
  app.add_option("--unit", options.file.text_unit, "text: unit of the times")
      ->check(CLI::IsMember({"auto", "s", "us"}))
      ->capture_default_str();
}

RunSummary run(EventReader& events, const TrackerSetup& setup, const Options& options,
               const OnTick& on_tick) {
  if (options.real_time) return run_in_real_time(events, setup, on_tick);
  if (options.as_fast_as_possible) return run_as_fast_as_possible(events, setup);
  return run_at_rate(events, setup, options.rate_hz, on_tick);
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(folder.string() + ": no folder can be made here: " + error.message());
  }
}

void evaluate(const Options& options) {
  const bool is_log = is_lcm_log(options.events);
  auto events =
      is_log ? open_event_log(options.events) : open_event_file(options.events, options.file);
  if (!options.hot_pixel_mask.empty()) {
    events = std::make_unique<MaskedReader>(std::move(events),
                                            read_pixel_mask_file(options.hot_pixel_mask),
                                            options.hot_pixel_mask.string());
  }
  TrackerSetup setup;
  setup.algorithm = algorithm_from(options.algorithm).value();
  setup.preset = preset_from(options.preset).value();
  const std::filesystem::path calibration = find_calibration(options.events, options.size_model);
  setup.size_model = read_size_model_file(calibration);
  setup.contour = read_contour_calibration(calibration).value_or(ContourCalibration{});
  setup.without = options.without;
  setup.roi_only = options.roi_only;
  for (const std::string& doubt : doubts_about(setup.size_model, events->sensor_size())) {
    std::fprintf(stderr, "puck-evaluate: %s\n", doubt.c_str());
  }
  if (!options.detection_region.empty()) {
    setup.detection_region = parse_region(options.detection_region);
  }
  std::optional<AccuracyScore> score;
  if (!options.as_fast_as_possible) {
    std::vector<TruthRow> truth;
    if (!options.truth.empty()) {
      truth = read_truth_file(options.truth);
    } else if (is_log) {
      truth = read_truth_log(options.events);
    }
    if (!truth.empty()) score.emplace(TruthTrack(std::move(truth)), events->sensor_size());
  }
  if (!options.plots.empty() && !score) {
    throw std::invalid_argument("--plots needs --truth, and ticks: not --as-fast-as-possible");
  }
  // Before the run: who waited for it shall not lose it to a folder that can't be.
  if (!options.plots.empty()) make_output_folder(options.plots);
  std::optional<TickFile> ticks;
  if (!options.csv.empty()) ticks.emplace(options.csv);

  EvaluationReport report;
  report.algorithm = options.algorithm;
  if (setup.algorithm == Algorithm::kPuck) report.preset = options.preset;
  report.run = run(*events, setup, options, [&](const EvaluatedTick& tick) {
    if (score) score->add(tick.tick, tick.estimate);
    if (ticks) ticks->add(tick);
  });
  for (const std::string& warning : events->warnings()) {
    std::fprintf(stderr, "puck-evaluate: %s\n", warning.c_str());
  }
  if (score) {
    report.accuracy = score->report();
    if (const auto warning = truth_warning(*score, report.run)) {
      std::fprintf(stderr, "puck-evaluate: %s\n", warning->c_str());
    }
  }
  if (ticks) ticks->close();
  print(report);
  if (!options.json.empty()) write_json(report, options.json);
  // Where not one tick counts there is nothing to plot, which has been told.
  if (!options.plots.empty() && !score->samples().empty()) write_plots(*score, options.plots);
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) {
  CLI::App app("Runs a tracker over a recording and says how accurate, quick or fast it is.");
  puck::Options options;
  puck::add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    puck::evaluate(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-evaluate: %s\n", error.what());
    return 1;
  }
  return 0;
}
