#include "tools/play/shot.h"

#include <cmath>

#include "tools/play/closed_loop.h"

namespace puck {
namespace {

constexpr double kThere_m = 0.04;
constexpr double kTrackedShare = 0.7;
constexpr std::int64_t kNoticedUs = 300'000;
constexpr std::int64_t kPatienceUs = 3'000'000;

GoalCause cause_of(const ShotFacts& facts, const ShotOutcome& outcome) {
  if (!facts.is_reachable) return GoalCause::kNotReachable;
  if (outcome.tracked_share < kTrackedShare) return GoalCause::kNotTracked;
  if (std::abs(outcome.command_error_m) > kThere_m) return GoalCause::kMispredicted;
  if (std::abs(outcome.mallet_error_m) > kThere_m) return GoalCause::kLate;
  return GoalCause::kDeflected;
}

// Follows the shot from the hit to the crossing.
class FlightWatch {
 public:
  FlightWatch(const ShotFacts& facts, ShotOutcome& outcome) : facts_(facts), outcome_(outcome) {}

  void watch(const ClosedLoop& loop) {
    if (loop.now() <= facts_.hit || loop.now() > facts_.crossing) return;
    ++steps_;
    if (loop.is_tracked()) ++tracked_;
    outcome_.tracked_share = static_cast<double>(tracked_) / steps_;
    outcome_.command_error_m = loop.target_m().value_or(0) - facts_.crossing_y_m;
    outcome_.mallet_error_m = loop.truth().robot_mallet.y_m - facts_.crossing_y_m;
    if (std::abs(outcome_.command_error_m) > kThere_m) {
      outcome_.settled_us.reset();
    } else if (!outcome_.settled_us) {
      outcome_.settled_us = loop.now() - facts_.hit;
    }
  }

 private:
  const ShotFacts& facts_;
  ShotOutcome& outcome_;
  int steps_ = 0;
  int tracked_ = 0;
};

}  // namespace

std::string_view to_string(GoalCause cause) {
  switch (cause) {
    case GoalCause::kNotReachable:
      return "not_reachable";
    case GoalCause::kNotTracked:
      return "not_tracked";
    case GoalCause::kMispredicted:
      return "mispredicted";
    case GoalCause::kLate:
      return "late";
    case GoalCause::kDeflected:
      return "deflected";
  }
  return "unknown";
}

ShotOutcome play_shot(const PlaySetup& setup, const ShotFacts& facts) {
  ClosedLoop loop(setup, facts.seed);
  ShotOutcome outcome;
  FlightWatch flight(facts, outcome);
  Timestamp end = facts.crossing + kPatienceUs;
  while (loop.now() < end) {
    loop.step();
    flight.watch(loop);
    const GameCounts& counts = loop.truth().counts;
    if (outcome.end == ShotOutcome::End::kUnjudged && counts.saves + counts.goals_against > 0) {
      outcome.end = counts.goals_against > 0 ? ShotOutcome::End::kGoal : ShotOutcome::End::kSaved;
      end = loop.now() + kNoticedUs;
    }
  }
  if (outcome.end == ShotOutcome::End::kGoal) outcome.cause = cause_of(facts, outcome);
  outcome.belief = loop.bridge().game();
  outcome.played_us = loop.now().us;
  return outcome;
}

}  // namespace puck
