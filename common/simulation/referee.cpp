#include "common/simulation/referee.h"

namespace puck {
namespace {

constexpr double kHitOver_s = 0.01;

}  // namespace

Referee::Referee(const PuckPhysics& physics) : physics_(physics) {}

void Referee::opponent_touched(const DiscState& before, double t_s) {
  if (open_hit_ == Hit::kRobots) judge(before);
  open_hit_ = Hit::kOpponents;
  last_contact_s_ = t_s;
}

void Referee::robot_touched(const DiscState& before, double t_s) {
  if (open_hit_ == Hit::kOpponents) judge(before);
  open_hit_ = Hit::kRobots;
  last_contact_s_ = t_s;
}

void Referee::puck_deflected(const DiscState& after) {
  if (shot_under_way_) shot_under_way_ = physics_.would_enter_robots_goal(after);
}

void Referee::watch(const DiscState& puck, double t_s) {
  if (open_hit_ != Hit::kNone && t_s - last_contact_s_ > kHitOver_s) judge(puck);
}

void Referee::puck_left(const DiscState& puck, GoalEntered goal) {
  if (goal == GoalEntered::kRobots) {
    if (open_hit_ == Hit::kOpponents && !shot_under_way_) ++counts_.shots;
    ++counts_.goals_against;
  } else if (open_hit_ != Hit::kNone) {
    judge(puck);
  }
  if (goal == GoalEntered::kOpponents) ++counts_.goals_for;
  open_hit_ = Hit::kNone;
  shot_under_way_ = false;
}

void Referee::judge(const DiscState& puck) {
  const bool enters = physics_.would_enter_robots_goal(puck);
  if (open_hit_ == Hit::kOpponents) {
    if (enters && !shot_under_way_) ++counts_.shots;
    shot_under_way_ = enters;
  } else if (shot_under_way_ && !enters) {
    ++counts_.saves;
    shot_under_way_ = false;
  }
  open_hit_ = Hit::kNone;
}

}  // namespace puck
