#include "tools/play/program.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <thread>

#include "tools/command_line/flush_stdout.h"
#include "tools/play/crossing_predictions.h"
#include "tools/play/error_model_check.h"
#include "tools/play/logged_game.h"
#include "tools/play/plots.h"
#include "tools/play/report.h"
#include "tools/play/shot_series.h"
#include "tools/play/sweep.h"
#include "tools/play/whole_game.h"

namespace puck {
namespace {

constexpr double kGameSpeed_m_s = 4;
constexpr double kSweepSpeed_m_s = 15;
constexpr int kSweepShots = 200;
constexpr double kGameSeconds = 60;

PlaySetup setup_of(const PlayOptions& options) {
  PlaySetup setup = default_setup(options.calibration);
  setup.world.moving_camera = options.moving;
  setup.link.latency_us = static_cast<std::int64_t>(1000 * options.latency_ms);
  setup.link.rate_hz = options.rate_hz;
  setup.link.loss_percent = options.loss_percent;
  setup.link.burst_us = static_cast<std::int64_t>(1000 * options.burst_ms);
  if (options.source == "events") setup.source = EstimateSource::kEvents;
  if (options.frames_hz > 0) {
    setup.source = EstimateSource::kFrames;
    setup.frames.rate_hz = options.frames_hz;
  }
  set_shot_speed(setup.world.game,
                 options.max_speed_m_s > 0 ? options.max_speed_m_s : kGameSpeed_m_s);
  return setup;
}

void run_sweep(const PlayOptions& options, int jobs) {
  const double speed_m_s = options.max_speed_m_s > 0 ? options.max_speed_m_s : kSweepSpeed_m_s;
  const PlannedSweep plan = plan_sweep(options.sweep, setup_of(options), speed_m_s);
  const SweepSettings settings{options.shots > 0 ? options.shots : kSweepShots, options.seed, jobs};
  std::size_t done = 0;
  const Sweep sweep = run_sweep(plan, settings, [&](const SweepPoint&) {
    std::fprintf(stderr, "\r%zu of %zu points", ++done, plan.points.size());
    if (done == plan.points.size()) std::fputc('\n', stderr);
  });
  print(sweep);
  if (!options.json.empty()) write_json(sweep, options.json);
  if (!options.plots.empty()) write_plot(sweep, options.plots);
}

void tell(const SaveFigures& figures, const PlayOptions& options) {
  print(figures);
  if (!options.json.empty()) write_json(figures, options.json);
}

void run_shots(const PlayOptions& options, int jobs) {
  const PlaySetup setup = for_single_shots(setup_of(options));
  const auto shots = find_shots(setup, options.seed, options.shots, jobs);
  const ShotSeries series = play_series(setup, shots, jobs);
  std::optional<PredictionReport> predictions;
  if (options.predictions) predictions = score_predictions(setup, shots, jobs);
  if (predictions) print(*predictions);
  tell(series.figures, options);
  if (options.plots.empty()) return;
  write_plot(shots, series.outcomes, options.plots);
  if (predictions) write_plot(*predictions, options.plots);
}

}  // namespace

void run(const PlayOptions& options) {
  const int jobs = options.jobs > 0
                       ? options.jobs
                       : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (!options.sweep.empty()) {
    run_sweep(options, jobs);
  } else if (options.fits_errors) {
    print(
        check_error_model(for_single_shots(setup_of(options)), options.seed, options.shots, jobs));
  } else if (!options.log.empty()) {
    tell(figures_of_log(options.log), options);
  } else if (options.shots > 0) {
    run_shots(options, jobs);
  } else {
    tell(play_game(setup_of(options), options.seed,
                   options.seconds > 0 ? options.seconds : kGameSeconds),
         options);
  }
  flush_stdout();
}

}  // namespace puck
