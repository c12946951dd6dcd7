#include "tools/play/whole_game.h"

#include <chrono>

#include "tools/play/closed_loop.h"

namespace puck {

SaveFigures play_game(const PlaySetup& setup, std::int64_t seed, double seconds) {
  const auto begin = std::chrono::steady_clock::now();
  ClosedLoop loop(setup, seed);
  const Timestamp end{static_cast<std::int64_t>(seconds * 1e6)};
  while (loop.now() < end) loop.step();

  const GameCounts& counts = loop.truth().counts;
  const GameBelief& belief = loop.bridge().game();
  SaveFigures figures;
  figures.shots = counts.shots;
  figures.saves = counts.saves;
  figures.goals = counts.goals_against;
  figures.believed_shots = belief.shots;
  figures.believed_saves = belief.saves;
  figures.believed_goals = belief.goals_against;
  figures.played_s = static_cast<double>(loop.now().us) * 1e-6;
  figures.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return figures;
}

}  // namespace puck
