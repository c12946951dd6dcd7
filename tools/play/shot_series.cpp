#include "tools/play/shot_series.h"

#include <chrono>
#include <stdexcept>
#include <string>

#include "common/runtime/parallel.h"

namespace puck {
namespace {

// Distance between the seeds of different runs.
constexpr std::int64_t kSeedsOfARun = 1'000'000;

}  // namespace

PlaySetup for_single_shots(PlaySetup setup) {
  GameParams& game = setup.world.game;
  game.served_at_start = true;
  // After the start; the serve takes 0.5 s.
  game.wait_min_s = 0.6;
  game.wait_max_s = 0.9;
  return setup;
}

std::vector<ShotFacts> find_shots(const PlaySetup& setup, std::int64_t seed, int count, int jobs) {
  constexpr int kAtATime = 64;
  constexpr int kMostGames = 20;  // per shot
  std::vector<ShotFacts> shots;
  std::int64_t next = seed * kSeedsOfARun;
  for (int tried = 0; static_cast<int>(shots.size()) < count; tried += kAtATime) {
    if (tried > kMostGames * count + kAtATime) {
      throw std::runtime_error(
          "too few of the opponent's shots aim at the goal: " + std::to_string(shots.size()) +
          " shots in " + std::to_string(tried) + " games");
    }
    std::vector<ShotFacts> found(kAtATime);
    run_in_parallel(jobs, found.size(), [&](std::size_t i) {
      found[i] = find_shot(setup, next + static_cast<std::int64_t>(i));
    });
    next += kAtATime;
    for (const ShotFacts& facts : found) {
      if (facts.is_shot && static_cast<int>(shots.size()) < count) shots.push_back(facts);
    }
  }
  return shots;
}

std::vector<ShotOutcome> play_shots(const PlaySetup& setup, const std::vector<ShotFacts>& shots,
                                    int jobs) {
  std::vector<ShotOutcome> outcomes(shots.size());
  run_in_parallel(jobs, shots.size(),
                  [&](std::size_t i) { outcomes[i] = play_shot(setup, shots[i]); });
  return outcomes;
}

ShotSeries play_series(const PlaySetup& setup, const std::vector<ShotFacts>& shots, int jobs) {
  const auto begin = std::chrono::steady_clock::now();
  ShotSeries series{play_shots(setup, shots, jobs), {}};
  for (std::size_t i = 0; i < shots.size(); ++i) series.figures.add(shots[i], series.outcomes[i]);
  series.figures.took_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return series;
}

SaveFigures measure_saves(const PlaySetup& setup, const std::vector<ShotFacts>& shots, int jobs) {
  return play_series(setup, shots, jobs).figures;
}

}  // namespace puck
