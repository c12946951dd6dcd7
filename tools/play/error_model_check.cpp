#include "tools/play/error_model_check.h"

#include <cstdio>
#include <vector>

#include "common/runtime/parallel.h"
#include "tools/play/closed_loop.h"
#include "tools/play/court.h"
#include "tools/play/error_fit.h"
#include "tools/play/shot_series.h"

namespace puck {
namespace {

void print_saves(const char* what, const SaveFigures& figures) {
  const Interval interval = wilson_interval(figures.saves, figures.shots);
  std::printf("  %-10s %4lld shots, saved %5.1f %%  (95 %%: %.1f to %.1f), bound %.1f %%\n", what,
              static_cast<long long>(figures.shots), figures.save_percent(), 100 * interval.low,
              100 * interval.high, figures.bound_percent().value_or(0));
}

}  // namespace

FlightErrors watch_flight(const PlaySetup& setup, const ShotFacts& facts) {
  const auto period_us = static_cast<std::int64_t>(1e6 / setup.link.rate_hz);
  ClosedLoop loop(setup, facts.seed);
  FlightErrorWatch watch(facts, exact_table_from_image(setup.world));
  // The loop calls this within a step, after the world has advanced.
  loop.on_estimate([&](const PuckEstimate& estimate) {
    watch.see(loop.truth());
    watch.see(estimate, period_us);
  });
  while (loop.now() < facts.crossing) loop.step();
  return watch.errors();
}

ErrorModelCheck check_error_model(PlaySetup setup, std::int64_t seed, int count, int jobs) {
  const std::vector<ShotFacts> shots = find_shots(setup, seed, count, jobs);
  ErrorModelCheck check;
  setup.source = EstimateSource::kTruth;
  check.on_model = measure_saves(setup, shots, jobs);
  setup.source = EstimateSource::kEvents;
  check.on_events = measure_saves(setup, shots, jobs);
  std::vector<FlightErrors> flights(shots.size());
  run_in_parallel(jobs, shots.size(),
                  [&](std::size_t i) { flights[i] = watch_flight(setup, shots[i]); });
  check.fitted = fit_estimate_errors(flights, static_cast<std::int64_t>(1e6 / setup.link.rate_hz));
  return check;
}

void print(const ErrorModelCheck& check) {
  const EstimateErrorParams& p = check.fitted;
  std::printf("PUCK's errors on events, in flight:\n");
  std::printf("  sigma_x_px         %8.3f\n  sigma_y_px         %8.3f\n", p.sigma_x_px,
              p.sigma_y_px);
  std::printf("  correlation_us     %8.0f\n  lag_us             %8.0f\n", p.correlation_us,
              p.lag_us);
  std::printf("  bias_x_px          %8.3f\n  bias_y_px          %8.3f\n", p.bias_x_px, p.bias_y_px);
  std::printf("  reported_sigma_px  %8.3f\n  detection_us       %8.0f\n", p.reported_sigma_px,
              p.detection_us);
  std::printf("  notice_us          %8.0f\n", p.notice_us);
  std::printf("  loss_share         %8.3f\n  loss_us            %8.0f\n", p.loss_share, p.loss_us);
  std::printf("saves on the same shots:\n");
  print_saves("events", check.on_events);
  print_saves("model", check.on_model);
}

}  // namespace puck
