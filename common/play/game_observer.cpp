#include "common/play/game_observer.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr double kSlowMS = 0.05;    // below: at rest
constexpr double kComingMS = -0.1;  // slower towards the robot is no shot
constexpr std::int64_t kStuckUs = 2'000'000;
constexpr std::int64_t kUnseenUs = 200'000;  // then in a goal or out of view
constexpr std::int64_t kSureUs = 30'000;     // hides changes by the track's noise
constexpr double kSureSigmas = 2;
constexpr double kHorizonS = 3.0;
constexpr int kMaxBounces = 4;
// Share of its radius by which a puck may overlap a goal post and still go in.
constexpr double kPostShare = 0.68;
// Misses beside a post by less than this may be errors of the prediction.
constexpr double kBesideGoalM = 0.05;
// A puck that came nearer to the end than this turned back at the rail.
constexpr double kBesideRailM = 0.1;
// Only this near to a goal can a puck vanish in it.
constexpr double kBeforeGoalM = 0.5;
constexpr double kBeforeGoalS = 0.15;

}  // namespace

// The goal whose area contains the puck's centre, behind an end rail's line.
GameObserver::Goal GameObserver::goal_around(const TablePoint& place) const {
  const TableGeometry& table = motion_.table();
  if (std::abs(place.y_m) > table.goal_width_m / 2) return Goal::kNone;
  if (place.x_m < 0) return Goal::kRobots;
  return place.x_m > table.length_m ? Goal::kOpponents : Goal::kNone;
}

// Whether the puck entered the goal: it may come to rest there before it vanishes. A puck that is
// first seen there is a new one, being served.
bool GameObserver::is_in_goal(const PuckTrack& track) const {
  const Goal around = goal_around(track.state.position);
  return around != Goal::kNone && around == outlook_.near;
}

GameObserver::Outlook GameObserver::look_ahead(const PuckTrack& track) const {
  if (is_in_goal(track)) return {outlook_.near, true, true, 0};
  PuckTrack at = track;
  double elapsed_s = 0;
  for (int bounces = 0; bounces <= kMaxBounces && elapsed_s < kHorizonS; ++bounces) {
    const TableVelocity velocity = at.state.velocity;
    const PuckMotion::Leg leg = motion_.next_leg(at, kHorizonS - elapsed_s);
    const bool comes = velocity.x_m_s < 0;
    const double to_end_s = time_to_end(at.state);
    if (to_end_s <= leg.duration_s) {
      const PuckTrack end = motion_.glide(at, to_end_s);
      const auto [inside_m, per_m] = beside_posts(end.state.position.y_m, velocity);
      const double sigma_m = per_m * std::sqrt(std::max(0.0, end.covariance(1, 1)));
      const Goal near = inside_m < -kBesideGoalM ? Goal::kNone
                        : comes                  ? Goal::kRobots
                                                 : Goal::kOpponents;
      // Bounces are known to a few per cent only, with a systematic error.
      const bool is_sure = bounces == 0 && std::abs(inside_m) > kSureSigmas * sigma_m;
      return {near, inside_m >= 0, is_sure, elapsed_s + to_end_s};
    }
    elapsed_s += leg.duration_s;
    if (leg.end == PuckMotion::LegEnd::kTimeUp) break;
    at = leg.track;
  }
  return {Goal::kNone, false, false, elapsed_s};
}

// Time until the rim touches the end rail's line ahead, in the goal's mouth or beside it.
double GameObserver::time_to_end(const PuckState& state) const {
  const TableGeometry& table = motion_.table();
  const bool comes = state.velocity.x_m_s < 0;
  const double line_x_m = comes ? table.puck_radius_m : table.length_m - table.puck_radius_m;
  const double x_m = state.position.x_m;
  const bool is_there = state.velocity.x_m_s != 0 && (comes ? x_m <= line_x_m : x_m >= line_x_m);
  return is_there ? 0 : motion_.time_to_x(state, line_x_m);
}

// Distance by which a puck that touches the end rail's line at `y_m` passes the nearer goal post on
// the inside, and its derivative by `y_m`. The posts are a puck's radius behind the centre then.
std::pair<double, double> GameObserver::beside_posts(double y_m, TableVelocity velocity) const {
  const TableGeometry& table = motion_.table();
  const double speed_m_s = std::max(1e-6, std::hypot(velocity.x_m_s, velocity.y_m_s));
  const double across = std::abs(velocity.x_m_s) / speed_m_s;
  const double along = velocity.y_m_s / speed_m_s;
  const double half_m = table.goal_width_m / 2;
  const double left_m = (half_m - y_m) * across - table.puck_radius_m * along;
  const double right_m = (half_m + y_m) * across + table.puck_radius_m * along;
  return {std::min(left_m, right_m) - kPostShare * table.puck_radius_m, across};
}

void GameObserver::enter(GamePhase phase, Timestamp t) {
  if (phase == belief_.phase) return;
  belief_.phase = phase;
  belief_.phase_since = t;
}

void GameObserver::end_rally() {
  belief_.rally_hits = 0;
  attack_open_ = false;
  shot_open_ = false;
  threat_ = false;
  changing_since_.reset();
  hits_.forget();
}

void GameObserver::decide_attack(bool enters) {
  attack_open_ = false;
  if (enters && !shot_open_) {
    ++belief_.shots;
    shot_touched_ = false;
    nearest_m_ = motion_.table().length_m;
  }
  shot_open_ = enters;
}

void GameObserver::save() {
  ++belief_.saves;
  shot_open_ = false;
}

void GameObserver::follow_hits(Timestamp t, const PuckTrack& track) {
  const std::optional<TableVelocity> change = hits_.see(t, track);
  if (!change) return;
  ++belief_.rally_hits;
  belief_.longest_rally = std::max(belief_.longest_rally, belief_.rally_hits);
  // Direction before place, since a hit may be seen late.
  const double middle_m = motion_.table().length_m / 2;
  if (change->x_m_s < 0 || track.state.position.x_m > middle_m) {
    attack_open_ = true;
    attack_since_ = t;
    return;
  }
  // The decision rests on the prediction before the touch.
  if (attack_open_) decide_attack(outlook_.is_shot());
  shot_touched_ = true;
  astray_since_.reset();
}

void GameObserver::follow_shot(Timestamp t, const PuckTrack& track) {
  const bool comes = track.state.velocity.x_m_s < kComingMS;
  const bool enters = comes && outlook_.is_shot();
  if (attack_open_) {
    const bool here = track.state.position.x_m < motion_.table().length_m / 2;
    const bool away = track.state.velocity.x_m_s > -kComingMS && t - attack_since_ >= kSureUs;
    if (away || (here && outlook_.is_sure)) decide_attack(enters);
    return;
  }
  if (!shot_open_) return;
  nearest_m_ = std::min(nearest_m_, track.state.position.x_m);
  if (!shot_touched_) {
    if (comes) return;
    // It turned back without a visible hit: at the end rail, or at the mallet.
    shot_open_ = false;
    if (nearest_m_ > kBesideRailM) ++belief_.saves;
    return;
  }
  if (enters) {
    astray_since_.reset();
    return;
  }
  if (!astray_since_) astray_since_ = t;
  if (!comes || t - *astray_since_ >= kSureUs) save();
}

void GameObserver::see(Timestamp t, const PuckTrack& track) {
  const auto& velocity = track.state.velocity;
  const bool in_goal = is_in_goal(track);
  if (belief_.phase == GamePhase::kGoal) {
    // A puck in a goal counts once.
    if (in_goal) return;
    end_rally();
  }

  follow_hits(t, track);
  outlook_ = look_ahead(track);
  if (!in_goal) follow_shot(t, track);
  last_seen_ = t;
  last_track_ = track;
  if (std::hypot(velocity.x_m_s, velocity.y_m_s) >= kSlowMS) {
    slow_since_.reset();
  } else if (!slow_since_) {
    slow_since_ = t;
  }

  const bool threat = shot_open_ || (attack_open_ && outlook_.is_shot());
  if (threat == threat_) {
    changing_since_.reset();
  } else if (!changing_since_) {
    changing_since_ = t;
  } else if (t - *changing_since_ >= kSureUs) {
    threat_ = threat;
  }
  if (slow_since_ && t - *slow_since_ >= kStuckUs) {
    end_rally();
    enter(GamePhase::kPuckStuck, t);
  } else if (threat_) {
    enter(GamePhase::kShotAtRobot, t);
  } else if (belief_.rally_hits > 0) {
    enter(GamePhase::kRally, t);
  } else {
    enter(GamePhase::kWaiting, t);
  }
}

void GameObserver::miss(Timestamp t) {
  if (!last_seen_) return;
  slow_since_.reset();
  if (t - *last_seen_ < kUnseenUs) return;
  if (belief_.phase == GamePhase::kGoal || belief_.phase == GamePhase::kPuckOutOfView) return;

  const double x_m = last_track_.state.position.x_m;
  const double length_m = motion_.table().length_m;
  const bool soon = outlook_.in_s < kBeforeGoalS;
  if (outlook_.near == Goal::kRobots && (soon || x_m < kBeforeGoalM)) {
    if (attack_open_) decide_attack(true);
    ++belief_.goals_against;
    enter(GamePhase::kGoal, t);
  } else if (outlook_.near == Goal::kOpponents && (soon || x_m > length_m - kBeforeGoalM)) {
    if (shot_open_ && shot_touched_) save();
    ++belief_.goals_for;
    enter(GamePhase::kGoal, t);
  } else {
    if (shot_open_ && shot_touched_) save();
    enter(GamePhase::kPuckOutOfView, t);
  }
}

void GameObserver::forget_time() {
  end_rally();
  last_seen_.reset();
  slow_since_.reset();
  belief_.phase_since = {};
  belief_.phase = GamePhase::kWaiting;
}

}  // namespace puck
