#include "tools/evaluate/options.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "common/messaging/event_packing.h"
#include "common/trackers/tracker_setup.h"
#include "common/vision/presets.h"
#include "common/vision/surface/surface.h"
#include "tools/command_line/event_file_options.h"
#include "tools/command_line/event_filter_options.h"
#include "tools/command_line/log_prefix_option.h"
#include "tools/command_line/number_range.h"

namespace puck {
namespace {

void add_scoring_options(CLI::App& app, EvaluateOptions& options) {
  constexpr double kLongest_ms = 1e6;
  app.add_option_function<double>(
         "--truth-gap-ms",
         [&](double milliseconds) {
           options.has_truth_gap = true;
           options.accuracy.truth_gap_us = std::llround(milliseconds * 1e3);
         },
         "ticks between rows of the truth that are farther apart do not count (default 10)")
      ->check(number_range(0, kLongest_ms));
  app.add_option_function<double>(
         "--settle-ms",
         [&](double milliseconds) {
           options.accuracy.settle_us = std::llround(milliseconds * 1e3);
         },
         "ticks up to this time after the puck's first motion do not count (default 200; 0 where "
         "less than 1 s of truth follows that motion)")
      ->check(number_range(0, kLongest_ms));
  auto* marks = app.add_flag("--score-at-marks", options.score_at_marks,
                             "for sparse truth: ask the tracker at each row's own time as well, "
                             "and score these estimates alone");
  app.add_flag("--no-puck", options.no_puck,
               "the recording has no puck: all that is tracked is said and wrong")
      ->excludes("--truth")
      ->excludes(marks);
  app.add_option("--scoring", options.scoring,
                 "ours, or paper: as the paper's authors score, where each row of truth takes the "
                 "nearest estimate within 10 ms and a missing one is not penalised")
      ->check(CLI::IsMember({"ours", "paper"}))
      ->capture_default_str();
  for (const char* other : {"--real-time", "--as-fast-as-possible", "--replay"}) {
    marks->excludes(other);
  }
}

}  // namespace

void add_options(CLI::App& app, EvaluateOptions& options) {
  app.add_option("EVENTS", options.events, "recording of any format in docs/formats.md, or LCM log")
      ->required();
  app.add_option("--truth", options.truth,
                 "true positions: t_us,x,y,width,height[,visible], or boxes as lines `t y0 y1 x0 "
                 "x1`; a log of a simulated game has its own");
  std::vector<std::string> algorithms;
  for (const Algorithm algorithm : kAlgorithms) algorithms.emplace_back(to_string(algorithm));
  app.add_option("--algorithm", options.algorithm)
      ->check(CLI::IsMember(algorithms))
      ->capture_default_str();
  app.add_option("--preset", options.preset)
      ->check(CLI::IsMember(std::vector<std::string>(kPresetNames.begin(), kPresetNames.end())))
      ->capture_default_str();
  app.add_option("--surface", options.surface,
                 "picture that presets correlation, paper and reference track on")
      ->check(CLI::IsMember(std::vector<std::string>(kSurfaceNames.begin(), kSurfaceNames.end())))
      ->capture_default_str();
  app.add_option("--size-model", options.size_model, "TOML made by puck-calibrate size");
  app.add_option("--evidence", options.evidence,
                 "TOML made by puck-calibrate evidence: instead of what preset default has built "
                 "in");
  app.add_option("--scale-decision", options.scale_decision,
                 "NAME=FACTOR: multiplies a number of preset default's DecisionParams, to see what "
                 "depends on it")
      ->expected(1);
  add_event_filter_options(app, options.filter);
  app.add_option("--detection-region", options.detection_region, "x,y,w,h in px");
  app.add_flag("--roi-only", options.roi_only,
               "while there is a track, keep only its region of the surface up to date; presets "
               "correlation, paper and reference");
  auto* rate = app.add_option("--rate", options.rate_hz, "estimates a second of sensor time")
                   ->check(number_range(1, 1e6))
                   ->capture_default_str();
  auto* real_time = app.add_flag("--real-time", options.real_time,
                                 "play at the recording's pace: measures latency");
  auto* fast =
      app.add_flag("--as-fast-as-possible", options.as_fast_as_possible, "measures throughput");
  real_time->excludes(rate)->excludes(fast);
  fast->excludes(rate);
  auto* replay =
      app.add_flag(
             "--replay", options.replay,
             "of a log: repeat each of its estimates, after as many events, and compare; "
             "exit code 1 when they differ too much. The settings must be those of the tracker")
          ->excludes(rate)
          ->excludes(real_time)
          ->excludes(fast);
  app.add_option("--max-difference-px", options.max_difference_px,
                 "bound on the mean difference of a replay")
      ->check(number_range(0, 1e6))
      ->capture_default_str()
      ->needs(replay);
  app.add_flag("--exact", options.exact,
               "every estimate of a replay must be equal to the bit: those of a tracker that ran "
               "with tracker.reproducible are")
      ->needs(replay);
  app.add_option("--search-delay", options.search_delay_us,
                 "delay of search results, µs, as on a busy machine")
      ->check(number_range(0, 1e6))
      ->excludes(replay)
      ->excludes(real_time);
  constexpr double kLongest_s = 1e6;
  const auto seconds_into = [](std::int64_t& time_us) {
    return [&time_us](double seconds) { time_us = std::llround(seconds * 1e6); };
  };
  app.add_option_function<double>("--start", seconds_into(options.part.from_us),
                                  "seconds after the first event at which to begin, without the "
                                  "events before")
      ->check(number_range(0, kLongest_s))
      ->excludes(replay);
  app.add_option_function<double>("--seconds", seconds_into(options.part.length_us),
                                  "length of the part, s")
      ->check(number_range(1e-3, kLongest_s))
      ->excludes(replay);
  auto* drop = app.add_option_function<double>(
                      "--drop-packets",
                      [&options](double percent) {
                        options.drops_packets = true;
                        options.loss.drop_percent = percent;
                      },
                      "cut the events into packets as a camera would, and drop this percentage of "
                      "them; compare with 0")
                   ->check(number_range(0, 100))
                   ->excludes(replay);
  app.add_option("--drop-seed", options.loss.seed, "the same seed loses the same packets")
      ->capture_default_str()
      ->needs(drop);
  app.add_option("--packet-bytes", options.loss.packet_bytes,
                 "largest packet; the default fits one Ethernet frame")
      ->check(number_range(EventPackerParams::kMinBytes, EventPackerParams::kMaxBytes))
      ->capture_default_str()
      ->needs(drop);
  add_scoring_options(app, options);
  app.add_option("--json", options.json, "write the figures here");
  app.add_option("--csv", options.csv, "write a row a tick here");
  app.add_option("--plots", options.plots,
                 "write charts and their data, as PNG and CSV, into this folder");
  app.add_option("--curves", options.curves,
                 "write within.csv and score.csv, data of these charts, into this folder");
  add_log_prefix_option(app, options.prefix);
  add_event_file_options(app, options.file);
}

}  // namespace puck
