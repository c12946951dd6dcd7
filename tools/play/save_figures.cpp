#include "tools/play/save_figures.h"

#include <algorithm>
#include <cmath>

namespace puck {

Interval wilson_interval(std::int64_t successes, std::int64_t of) {
  if (of == 0) return {};
  constexpr double kZ = 1.959963985;  // The 97.5 % quantile of a normal distribution.
  const auto n = static_cast<double>(of);
  const double share = static_cast<double>(successes) / n;
  const double scale = 1 / (1 + kZ * kZ / n);
  const double centre = scale * (share + kZ * kZ / (2 * n));
  const double half = scale * kZ * std::sqrt(share * (1 - share) / n + kZ * kZ / (4 * n * n));
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

void SaveFigures::add(const ShotFacts& facts, const ShotOutcome& outcome) {
  ++shots;
  if (outcome.end == ShotOutcome::End::kSaved) ++saves;
  if (outcome.end == ShotOutcome::End::kGoal) ++goals;
  if (!causes) causes.emplace();
  if (outcome.cause) ++(*causes)[static_cast<std::size_t>(*outcome.cause)];
  reachable = reachable.value_or(0) + (facts.is_reachable ? 1 : 0);
  waiting = waiting.value_or(0) + (facts.hits_waiting_mallet ? 1 : 0);
  sum_speed_m_s = sum_speed_m_s.value_or(0) + facts.speed_m_s;
  believed_shots += outcome.belief.shots;
  believed_saves += outcome.belief.saves;
  believed_goals += outcome.belief.goals_against;
  played_s += static_cast<double>(outcome.played_us) * 1e-6;
}

}  // namespace puck
