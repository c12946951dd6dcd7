#include "tools/play/options.h"

#include "tools/command_line/number_range.h"
#include "tools/play/option_ranges.h"

namespace puck {
namespace {

CLI::Validator values(const OptionRange& range) {
  return number_range(range.lowest, range.highest);
}

}  // namespace

void add_options(CLI::App& app, PlayOptions& options) {
  auto* seconds = app.add_option("--seconds", options.seconds, "length of a whole game")
                      ->check(number_range(0.1, 100'000));
  auto* shots = app.add_option("--shots", options.shots,
                               "number of single shots, each a game of its own, instead of a "
                               "whole game")
                    ->check(number_range(1, 100'000))
                    ->excludes(seconds);
  app.add_option(kMaxSpeedRange.option, options.max_speed_m_s,
                 "speed of the fastest shots, m/s; the slowest are half as fast (default: 4; "
                 "15 with --sweep)")
      ->check(values(kMaxSpeedRange));
  auto* source = app.add_option("--source", options.source,
                                "truth: the true position plus the errors of PUCK; events: "
                                "PUCK on the events of the simulated camera")
                     ->check(CLI::IsMember({"truth", "events"}))
                     ->capture_default_str();
  auto* sweep = app.add_option("--sweep", options.sweep,
                               "save rate as a function of this quantity; --shots a point "
                               "(default 200)")
                    ->check(CLI::IsMember({"latency", "speed", "loss", "rate"}))
                    ->excludes(seconds);
  app.add_option(kLatencyRange.option, options.latency_ms,
                 "delay from the sensor to the bridge and the arm, ms")
      ->check(values(kLatencyRange))
      ->capture_default_str();
  app.add_option(kRateRange.option, options.rate_hz, "estimates a second")
      ->check(values(kRateRange))
      ->capture_default_str();
  auto* loss = app.add_option(kLossRange.option, options.loss_percent, "of the estimates")
                   ->check(values(kLossRange))
                   ->capture_default_str();
  app.add_option(kBurstRange.option, options.burst_ms,
                 "mean length of a burst of lost estimates, ms; 0: single losses")
      ->check(values(kBurstRange))
      ->needs(loss)
      ->capture_default_str();
  app.add_option(kFramesRange.option, options.frames_hz,
                 "simulate a tracker on a frame camera with this frame rate instead of PUCK")
      ->check(values(kFramesRange))
      ->excludes(source)
      ->excludes(sweep);
  app.add_flag("--moving", options.moving, "the camera's head turns; needs --source events")
      ->needs(source);
  app.add_option("--seed", options.seed, "the same seed plays the same game, to the bit")
      ->check(number_range(0, 100'000))
      ->capture_default_str();
  app.add_option("--jobs", options.jobs, "number of threads (default: one a core)")
      ->check(number_range(1, 256));
  auto* fit = app.add_flag("--fit-estimate-errors", options.fits_errors,
                           "measure the errors of PUCK on events (the model behind --source "
                           "truth), and print the save rates with both sources")
                  ->needs(shots)
                  ->excludes(source)
                  ->excludes(sweep);
  auto* predictions =
      app.add_flag("--predictions", options.predictions,
                   "also print the error of the predicted crossing as a function of the time "
                   "to go")
          ->needs(shots)
          ->excludes(sweep)
          ->excludes(fit);
  app.add_option("--log", options.log, "print the result of the game in this log, and play nothing")
      ->excludes(seconds)
      ->excludes(shots)
      ->excludes(sweep)
      ->excludes(fit)
      ->excludes(predictions);
  app.add_option("--calibration", options.calibration,
                 "folder with simulated_size.toml and simulated_table.toml")
      ->capture_default_str();
  app.add_option("--json", options.json, "write the figures here");
  app.add_option("--plots", options.plots, "write plots into this folder; needs --shots or --sweep")
      ->excludes(fit);
  app.callback([&options] {
    if (!options.plots.empty() && options.shots == 0 && options.sweep.empty()) {
      throw CLI::ValidationError("--plots needs --shots or --sweep: a whole game has no plots");
    }
    if (options.moving && options.source != "events") {
      throw CLI::ValidationError(
          "--moving needs --source events: the error model holds for a camera at rest");
    }
  });
}

}  // namespace puck
