#include "tools/play/crossing_predictions.h"

#include <array>
#include <cstdio>
#include <optional>

#include "common/runtime/parallel.h"
#include "tools/play/closed_loop.h"

namespace puck {
namespace {

struct Moment {
  Timestamp t;
  std::optional<Intercept> predicted;
};

std::vector<Moment> watch_predictions(const PlaySetup& setup, const ShotFacts& facts) {
  std::vector<Moment> moments;
  ClosedLoop loop(setup, facts.seed);
  loop.on_trajectory([&](const TableTrajectory& trajectory) {
    const Timestamp t = trajectory.at;
    if (t > facts.hit && t < facts.crossing) moments.push_back({t, trajectory.crossing});
  });
  while (loop.now() < facts.crossing) loop.step();
  return moments;
}

void print_bins(const char* name, const std::array<PredictionBin, PredictionReport::kBins>& bins) {
  for (const PredictionBin& bin : bins) {
    if (bin.predictions == 0) continue;
    std::printf("  %-9s %4.1f to %.1f s  %8lld  %9.1f %9.1f  %9.1f %9.1f  %6.0f %6.0f\n", name,
                bin.from_s, bin.to_s, static_cast<long long>(bin.predictions), 1e3 * bin.median_m,
                1e3 * bin.p90_m, 1e3 * bin.median_s, 1e3 * bin.p90_s, bin.within_1_sigma_percent,
                bin.within_2_sigma_percent);
  }
}

}  // namespace

PredictionReport score_predictions(const PlaySetup& setup, const std::vector<ShotFacts>& shots,
                                   int jobs) {
  std::vector<std::vector<Moment>> moments(shots.size());
  run_in_parallel(jobs, shots.size(),
                  [&](std::size_t i) { moments[i] = watch_predictions(setup, shots[i]); });
  PredictionScore score;
  // Shifts the shots in time, as if played one after another.
  constexpr std::int64_t kApartUs = 100'000'000;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const std::int64_t begin_us = kApartUs * static_cast<std::int64_t>(i);
    score.interrupted(shots[i].hit + begin_us);
    for (const Moment& moment : moments[i]) score.add(moment.t + begin_us, moment.predicted);
    score.crossed(shots[i].crossing + begin_us, shots[i].crossing_y_m);
  }
  return score.report();
}

void print(const PredictionReport& report) {
  std::printf("predictions of %lld crossings, by the time to go:\n",
              static_cast<long long>(report.crossings));
  std::printf("  %-24s %10s  %9s %9s  %9s %9s  %6s %6s\n", "", "number", "p50, mm", "p90, mm",
              "p50, ms", "p90, ms", "1s, %", "2s, %");
  print_bins("direct", report.direct);
  print_bins("bounced", report.bounced);
}

}  // namespace puck
