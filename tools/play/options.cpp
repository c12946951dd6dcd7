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
                               "so many single shots, each a game of its own, instead")
                    ->check(number_range(1, 100'000))
                    ->excludes(seconds);
  app.add_option(kMaxSpeedRange.option, options.max_speed_m_s,
                 "of the shots, m/s; the slowest are half as fast (default: 4, of a sweep 15)")
      ->check(values(kMaxSpeedRange));
  auto* source = app.add_option("--source", options.source,
                                "truth: where the puck truly is, with PUCK's errors; events: PUCK "
                                "on the simulated camera's events")
                     ->check(CLI::IsMember({"truth", "events"}))
                     ->capture_default_str();
  auto* sweep = app.add_option("--sweep", options.sweep,
                               "how the save rate falls as this grows; --shots of each point "
                               "(default 200)")
                    ->check(CLI::IsMember({"latency", "speed", "loss", "rate"}))
                    ->excludes(seconds);
  app.add_option(kLatencyRange.option, options.latency_ms,
                 "from the sensor to the bridge and the arm")
      ->check(values(kLatencyRange))
      ->capture_default_str();
  app.add_option(kRateRange.option, options.rate_hz, "estimates a second")
      ->check(values(kRateRange))
      ->capture_default_str();
  auto* loss = app.add_option(kLossRange.option, options.loss_percent, "of the estimates")
                   ->check(values(kLossRange))
                   ->capture_default_str();
  app.add_option(kBurstRange.option, options.burst_ms,
                 "estimates are lost in bursts that take so long on average; 0: one by one")
      ->check(values(kBurstRange))
      ->needs(loss)
      ->capture_default_str();
  app.add_option(kFramesRange.option, options.frames_hz,
                 "instead of PUCK a tracker on the pictures of a camera")
      ->check(values(kFramesRange))
      ->excludes(source)
      ->excludes(sweep);
  app.add_flag("--moving", options.moving, "the camera's head turns; with --source events")
      ->needs(source);
  app.add_option("--seed", options.seed, "the same seed plays the same game, to the bit")
      ->check(number_range(0, 100'000))
      ->capture_default_str();
  app.add_option("--jobs", options.jobs, "threads (default: one a core)")
      ->check(number_range(1, 256));
  auto* fit = app.add_flag("--fit-estimate-errors", options.fits_errors,
                           "print the errors that PUCK makes on events, as --source truth uses "
                           "them, and the save rates with both")
                  ->needs(shots)
                  ->excludes(source)
                  ->excludes(sweep);
  auto* predictions =
      app.add_flag("--predictions", options.predictions,
                   "also score how well the crossings are predicted, by the time to go")
          ->needs(shots)
          ->excludes(sweep)
          ->excludes(fit);
  app.add_option("--log", options.log, "only say what happened in this log of a game")
      ->excludes(seconds)
      ->excludes(shots)
      ->excludes(sweep)
      ->excludes(fit)
      ->excludes(predictions);
  app.add_option("--calibration", options.calibration,
                 "folder with simulated_size.toml and simulated_table.toml")
      ->capture_default_str();
  app.add_option("--json", options.json, "write the figures here");
  app.add_option("--plots", options.plots, "write plots into this folder; of --shots or a --sweep")
      ->excludes(fit);
  app.callback([&options] {
    if (!options.plots.empty() && options.shots == 0 && options.sweep.empty()) {
      throw CLI::ValidationError(
          "--plots needs --shots or --sweep: of a whole game there is nothing to plot");
    }
    if (options.moving && options.source != "events") {
      throw CLI::ValidationError(
          "--moving needs --source events: the truth is seen by a camera at rest");
    }
  });
}

}  // namespace puck
