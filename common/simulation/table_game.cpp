#include "common/simulation/table_game.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr std::uint64_t kServeStream = 3;
constexpr std::uint64_t kFreeHandStream = 4;
constexpr std::uint64_t kRestStream = 5;
constexpr std::uint64_t kSecondPuckStream = 6;
constexpr double kStuck_m_s = 0.08;
// Smooths the reports of a live arm, which come every few ms.
constexpr double kFollowGain_1_s = 200;
constexpr double kFollowSpeed_m_s = 5;
constexpr int kStepsPerPlan = 400;
constexpr double kGlideStep_s = 1e-3;

}  // namespace

TableGame::TableGame(const SimulationParams& params)
    : physics_(params.table, params.physics),
      params_(params.game),
      autonomous_robot_(params.autonomous_robot),
      random_(params.seed, kServeStream),
      opponent_(physics_, params.game, params.seed),
      free_hand_(params.table, params.game, {-params.camera.behind_m, 0, params.camera.height_m},
                 Random(params.seed, kFreeHandStream)),
      rest_(params.table, params.game, Random(params.seed, kRestStream)),
      referee_(physics_),
      arm_(params.arm, params.table.robot_line_half_m) {
  robot_.position.x_m = params.table.robot_line_x_m;
  if (params.game.second_puck_speed_m_s > 0) {
    second_puck_.emplace(params.table, params.physics, params.game.second_puck_speed_m_s,
                         Random(params.seed, kSecondPuckStream));
  }
  if (params_.served_at_start) {
    serve();
  } else {
    puck_ = DiscState{place_to_serve(), {}};
  }
}

void TableGame::step() {
  ++steps_;
  if (!puck_ && time_s() - off_since_s_ >= params_.serve_after_s && opponent_.is_home()) serve();
  move_robot();
  rest_.step(puck_, PuckPhysics::kStep_s);
  opponent_.step(puck_, PuckPhysics::kStep_s, opponents_conduct());
  free_hand_.step(puck_, PuckPhysics::kStep_s);
  if (second_puck_) second_puck_->step(robot_, opponent_.mallet());
  if (serve_.is_under_way()) {
    puck_ = serve_.step(PuckPhysics::kStep_s);
    last_moving_s_ = last_attack_s_ = time_s();
  } else if (puck_) {
    move_puck();
  }
}

Opponent::Conduct TableGame::opponents_conduct() const {
  if (serve_.is_under_way()) return Opponent::Conduct::kServes;
  return is_paused() ? Opponent::Conduct::kLeavesAlone : Opponent::Conduct::kPlays;
}

void TableGame::set_robot_mallet(double y_m) {
  if (!std::isfinite(y_m)) return;
  const double half_m = physics_.table().robot_line_half_m;
  robot_target_y_m_ = std::clamp(y_m, -half_m, half_m);
}

void TableGame::place_puck(const DiscState& puck) {
  serve_ = {};
  if (puck_) referee_.puck_left(*puck_, GoalEntered::kNone);
  puck_ = puck;
  last_moving_s_ = last_attack_s_ = time_s();
}

void TableGame::move_robot() {
  if (autonomous_robot_) {
    if (steps_ % kStepsPerPlan == 0) plan_robot_move();
    arm_.step(PuckPhysics::kStep_s);
    robot_.position.y_m = arm_.position_m();
    robot_.velocity.y_m_s = arm_.velocity_m_s();
    return;
  }
  robot_.velocity.y_m_s = std::clamp(kFollowGain_1_s * (robot_target_y_m_ - robot_.position.y_m),
                                     -kFollowSpeed_m_s, kFollowSpeed_m_s);
  robot_.position.y_m += robot_.velocity.y_m_s * PuckPhysics::kStep_s;
}

// Targets the point where the puck will cross the robot's line, else the middle.
void TableGame::plan_robot_move() {
  constexpr double kApproaching_m_s = -0.1;
  constexpr double kLongest_s = 2;
  double target_m = 0;
  if (puck_ && puck_->velocity.x_m_s < kApproaching_m_s) {
    const TableGeometry& table = physics_.table();
    const double meet_x_m = table.contact_line_x_m();
    DiscState ahead = *puck_;
    for (double t_s = 0; t_s < kLongest_s && ahead.position.x_m > meet_x_m; t_s += kGlideStep_s) {
      physics_.glide(ahead, kGlideStep_s);
    }
    target_m = ahead.position.y_m;
  }
  arm_.set_target(target_m);
}

void TableGame::move_puck() {
  const DiscState before_robot = *puck_;
  if (physics_.hit(*puck_, robot_)) {
    referee_.robot_touched(before_robot, time_s());
  }
  const DiscState before_opponent = *puck_;
  if (physics_.hit(*puck_, opponent_.mallet())) {
    referee_.opponent_touched(before_opponent, time_s());
    last_attack_s_ = time_s();
  }
  if (second_puck_ && second_puck_->collide(*puck_)) referee_.puck_deflected(*puck_);
  // After the hits, so that a mallet cannot press the puck through a rail.
  physics_.glide(*puck_, PuckPhysics::kStep_s);
  referee_.watch(*puck_, time_s());

  const GoalEntered goal = physics_.goal_of(*puck_);
  if (goal != GoalEntered::kNone) {
    take_puck_off(goal);
    return;
  }
  if (is_stuck()) take_puck_off(GoalEntered::kNone);
}

bool TableGame::is_stuck() {
  // A puck that moves but is not hit by the opponent is given this many times as long.
  constexpr double kWithoutAttack = 3;
  const double speed_m_s = std::hypot(puck_->velocity.x_m_s, puck_->velocity.y_m_s);
  if (speed_m_s > kStuck_m_s) last_moving_s_ = time_s();
  if (is_paused()) last_moving_s_ = last_attack_s_ = time_s();
  return time_s() - last_moving_s_ > params_.stuck_after_s ||
         time_s() - last_attack_s_ > kWithoutAttack * params_.stuck_after_s;
}

void TableGame::take_puck_off(GoalEntered goal) {
  referee_.puck_left(*puck_, goal);
  puck_.reset();
  off_since_s_ = time_s();
}

TablePoint TableGame::place_to_serve() {
  const TableGeometry& table = physics_.table();
  // Out of the mallet's reach on a short table too.
  const double farthest_m = opponent_.home().x_m - table.mallet_radius_m - 2 * table.puck_radius_m;
  const double x_m = std::min(random_.uniform(0.64, 0.76) * table.length_m, farthest_m);
  return {x_m, random_.uniform(-0.25, 0.25) * table.width_m};
}

// The opponent lays the puck down behind his mallet, hidden from the camera, and pushes it around
// the mallet.
void TableGame::serve() {
  const TableGeometry& table = physics_.table();
  const TablePoint to = place_to_serve();
  // The path reaches half this far to the side: past the mallet, with room for another puck.
  constexpr double kLeastAside_m = 0.3;
  const double aside_m =
      std::max(kLeastAside_m, 2 * (table.mallet_radius_m + 3 * table.puck_radius_m));
  const double behind_x_m =
      opponent_.home().x_m + table.mallet_radius_m + 1.8 * table.puck_radius_m;
  serve_ = PuckServe({behind_x_m, 0}, {behind_x_m, std::copysign(aside_m, to.y_m)}, to);
  puck_ = serve_.step(0);
}

}  // namespace puck
