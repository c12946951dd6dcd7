#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/io/contour_calibration_file.h"
#include "common/io/event_reader.h"
#include "common/io/evidence_file.h"
#include "common/io/filtered_reader.h"
#include "common/io/size_model_file.h"
#include "common/io/truth_file.h"
#include "common/recording/event_log_reader.h"
#include "common/recording/log_recording.h"
#include "common/trackers/tracker_setup.h"
#include "tools/command_line/run_tool.h"
#include "tools/evaluate/lossy_reader.h"
#include "tools/evaluate/options.h"
#include "tools/evaluate/part_reader.h"
#include "tools/evaluate/plots.h"
#include "tools/evaluate/replay.h"
#include "tools/evaluate/report.h"
#include "tools/evaluate/runs.h"
#include "tools/evaluate/scoring.h"
#include "tools/evaluate/tick_file.h"

namespace puck {
namespace {

// Runs the tracker; the result of a replay goes into the report.
RunSummary run(EventReader& events, const TrackerSetup& setup, const EvaluateOptions& options,
               EvaluationReport& report, const OnTick& on_tick, std::span<const Timestamp> marks) {
  if (options.replay) {
    ReplayResult result = run_replay(events, options.events, options.prefix, setup, on_tick);
    report.replay = std::move(result.comparison);
    return result.run;
  }
  if (options.real_time) return run_in_real_time(events, setup, on_tick);
  if (options.as_fast_as_possible) return run_as_fast_as_possible(events, setup);
  return run_at_rate(events, setup, options.rate_hz, on_tick, marks);
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(folder.string() +
                             ": the folder cannot be created: " + error.message());
  }
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::fprintf(stderr, "puck-evaluate: %s\n", warning.c_str());
  }
}

// Prints the reason to stderr if the replay is not close enough.
bool is_close_enough(const ReplayComparison& replay, const EvaluateOptions& options) {
  warn(replay.notes);
  if (options.exact && replay.equal < replay.estimates) {
    std::fprintf(stderr,
                 "puck-evaluate: %lld of %lld estimates are not equal to the bit; those of a "
                 "tracker with tracker.reproducible and the same settings are\n",
                 static_cast<long long>(replay.estimates - replay.equal),
                 static_cast<long long>(replay.estimates));
    return false;
  }
  if (replay.equal == replay.estimates) return true;
  if (replay.mean_difference_px && *replay.mean_difference_px <= options.max_difference_px) {
    return true;
  }
  std::fprintf(stderr, "puck-evaluate: the replay differs by more than %g px on average\n",
               options.max_difference_px);
  return false;
}

// False if a replay differs too much, or if truth and events have no time in common.
bool evaluate(const EvaluateOptions& options) {
  const bool is_log = is_lcm_log(options.events);
  if (options.replay && !is_log) {
    throw std::invalid_argument("--replay needs a log of LCM, with the estimates to compare with");
  }
  // Before its size model, which may be missing, too.
  check_recording_exists(options.events);
  const std::filesystem::path calibration = find_calibration(options.events, options.size_model);
  const PuckSizeModel size_model = read_size_model_file(calibration);
  EventFileOptions file = options.file;
  // The size model of another recording tells nothing about this one's sensor.
  const bool is_of_other =
      options.size_model.empty() && calibration.stem() != options.events.stem();
  if (!is_of_other) file.fallback_sensor = size_model.sensor;
  auto events = is_log ? open_event_log(options.events, options.prefix, EventLog::Sessions::kFirst)
                       : open_event_file(options.events, file);
  if (is_of_other) warn({"the size model is that of " + calibration.string()});
  std::optional<Timestamp> begin;
  if (!options.part.is_whole()) {
    auto part = std::make_unique<PartReader>(std::move(events), options.part);
    begin = part->begin();
    events = std::move(part);
  }
  events = std::make_unique<FilteredReader>(std::move(events), options.filter.with_files(),
                                            options.events.string());
  if (options.drops_packets) {
    events = std::make_unique<LossyReader>(std::move(events), options.loss);
  }
  TrackerSetup setup;
  setup.algorithm = algorithm_from(options.algorithm).value();
  setup.preset = preset_from(options.preset).value();
  setup.surface = surface_kind_from(options.surface).value();
  setup.size_model = size_model;
  setup.contour = read_contour_calibration(calibration).value_or(ContourCalibration{});
  if (!options.evidence.empty()) setup.evidence = read_evidence_file(options.evidence);
  setup.decision = scaled_decision(options.scale_decision);
  setup.roi_only = options.roi_only;
  setup.search_delay_us = options.search_delay_us;
  if (options.replay && setup.algorithm != Algorithm::kPuck) {
    throw std::invalid_argument("--replay needs algorithm puck, the only one of puck-tracker");
  }
  warn(doubts_about(search_params(setup.pipeline_params()).sizes_of(setup.size_model),
                    events->sensor_size()));
  if (!options.detection_region.empty()) {
    setup.detection_region = parse_region(options.detection_region);
  }
  std::vector<TruthRow> truth;
  if (!options.as_fast_as_possible) {
    if (!options.truth.empty()) {
      truth = read_truth_file(options.truth);
    } else if (is_log && !options.no_puck) {
      truth = read_truth_log(options.events, options.prefix);
    }
    // The tracker has not seen motion before the part.
    if (begin && !truth.empty()) {
      std::erase_if(truth, [&](const TruthRow& row) { return row.time < *begin; });
      if (truth.empty()) throw std::invalid_argument("the truth ends before --start");
    }
  }
  Scoring scoring(options, std::move(truth), events->sensor_size());
  for (const auto& [option, folder] :
       {std::pair("--plots", options.plots), std::pair("--curves", options.curves)}) {
    if (folder.empty()) continue;
    if (scoring.truth() == nullptr) {
      throw std::invalid_argument(std::string(option) +
                                  " needs --truth, and ticks: not --as-fast-as-possible");
    }
    // Before the run, so that a folder that cannot be made costs no result.
    make_output_folder(folder);
  }
  std::optional<TickFile> ticks;
  if (!options.csv.empty()) ticks.emplace(options.csv);

  EvaluationReport report;
  report.algorithm = options.algorithm;
  if (setup.algorithm == Algorithm::kPuck) report.preset = options.preset;
  report.run = run(
      *events, setup, options, report,
      [&](const EvaluatedTick& tick) {
        scoring.add(tick);
        if (ticks) ticks->add(tick);
      },
      scoring.marks());
  warn(events->warnings());
  scoring.write_to(report);
  warn(scoring.warnings(report));
  if (ticks) ticks->close();
  print(report);
  if (!options.json.empty()) write_json(report, options.json);
  // Without a scored tick there is nothing to plot; a warning was printed.
  const bool has_ticks = report.errors && report.errors->estimates > 0;
  if (has_ticks && !options.curves.empty()) write_curves(scoring.samples(), options.curves);
  if (has_ticks && !options.plots.empty()) write_plots(scoring.samples(), options.plots);
  if (scoring.is_of_another_time(report.run)) return false;
  return !report.replay || is_close_enough(*report.replay, options);
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) {
  CLI::App app("Runs a tracker over a recording and measures accuracy, latency or throughput.");
  puck::EvaluateOptions options;
  puck::add_options(app, options);
  return puck::run_tool(app, argc, argv, "puck-evaluate",
                        [&] { return puck::evaluate(options) ? 0 : 1; });
}
