#include "tools/compare/goals.h"

namespace puck {

std::vector<Goal> goals() {
  const std::vector<std::string> still{"still"};
  const std::vector<std::string> moving{"moving"};
  const std::vector<std::string> low_still{"low-contrast-still"};
  const std::vector<std::string> low_moving{"low-contrast-moving"};
  const std::vector<std::string> logos{"logos-moving"};
  const std::vector<std::string> fast_still{"fast-still"};
  const std::vector<std::string> fast_moving{"fast-moving"};
  // The sets of the rows above.
  const std::vector<std::string> all_still{"still", "low-contrast-still", "fast-still"};
  const std::vector<std::string> all_moving{"moving", "low-contrast-moving", "logos-moving",
                                            "fast-moving"};
  const auto mean = &Summary::mean_px;
  const auto lost = &Summary::lost_percent;
  const auto longest = &Summary::longest_loss_ms;
  const auto within = &Summary::within_3p5px_percent;
  const auto cpu = &Summary::cpu_us_per_ms;
  return {
      {"still: mean error, px", still, mean, false, 0.35, 0.25},
      {"still: lost, %", still, lost, false, {}, 0.0},
      {"still: longest loss, ms", still, longest, false, {}, 100.0},
      {"moving: mean error, px", moving, mean, false, 0.4, 0.3},
      {"moving: lost, %", moving, lost, false, {}, 0.1},
      {"moving: longest loss, ms", moving, longest, false, {}, 100.0},
      {"low contrast, 6 m/s, still: mean error, px", low_still, mean, false, {}, 1.6},
      {"low contrast, 6 m/s, still: lost, %", low_still, lost, false, {}, 1.0},
      {"low contrast, 5 m/s, moving: mean error, px", low_moving, mean, false, {}, 2.5},
      {"low contrast, 5 m/s, moving: lost, %", low_moving, lost, false, {}, 2.5},
      {"round logos, moving: mean error, px", logos, mean, false, {}, 0.4},
      {"round logos, moving: lost, %", logos, lost, false, {}, 0.3},
      {"shots to 15 m/s, still: lost, %", fast_still, lost, false, {}, 1.0},
      {"shots to 15 m/s, still: held, longest loss, ms", fast_still, longest, false, {}, 100.0},
      {"shots to 15 m/s, moving: lost, %", fast_moving, lost, false, {}, 1.0},
      {"shots to 15 m/s, moving: held, longest loss, ms", fast_moving, longest, false, {}, 100.0},
      {"within 3.5 px, still, %", still, within, true, {}, 98.0},
      {"within 3.5 px, moving, %", moving, within, true, {}, 96.0},
      {"within 3.5 px, all still of the above, %", all_still, within, true, {}, 98.0},
      {"within 3.5 px, all moving of the above, %", all_moving, within, true, {}, 96.0},
      {"still: to the first track, worst, ms", still, &Summary::time_to_first_track_ms},
      {"moving: to the first track, worst, ms", moving, &Summary::time_to_first_track_ms},
      {"still: NEES (honest: 2)", still, &Summary::nees_mean},
      {"still: NEES within its 95 % bound, %", still, &Summary::nees_within_95_percent},
      {"moving: NEES (honest: 2)", moving, &Summary::nees_mean},
      {"moving: NEES within its 95 % bound, %", moving, &Summary::nees_within_95_percent},
      {"still: events, Mev/s", still, &Summary::mev_s},
      {"still: CPU time a millisecond, us", still, cpu, false, {}, 50.0},
      {"moving: events, Mev/s", moving, &Summary::mev_s},
      {"moving: CPU time a millisecond, us", moving, cpu, false, {}, 200.0},
  };
}

std::optional<bool> GoalCell::reached() const {
  if (!bar) return std::nullopt;
  if (!measured) return false;
  return at_least ? *measured >= *bar : *measured <= *bar;
}

std::vector<GoalResult> check_goals(const Comparison& comparison) {
  std::vector<GoalResult> results;
  for (const Goal& goal : goals()) {
    const auto cell = [&](const char* contestant, std::optional<double> bar) {
      return GoalCell{comparison.summary(goal.sets, contestant).*goal.value, bar, goal.at_least};
    };
    results.push_back({goal.title, cell("reference", {}), cell("correlation", goal.by_correlation),
                       cell("default", goal.by_default)});
  }
  return results;
}

}  // namespace puck
