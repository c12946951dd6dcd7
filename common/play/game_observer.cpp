#include "common/play/game_observer.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr double kHeadingMS = 0.2;  // slower along the table is no direction
constexpr double kSlowMS = 0.05;    // slower is at rest
constexpr std::int64_t kStuckUs = 2'000'000;
constexpr std::int64_t kUnseenUs = 200'000;  // unseen for so long, it is in a goal or out of view
// The prediction flickers with the track's noise: it has to stay so long.
constexpr std::int64_t kSureUs = 30'000;
constexpr double kHorizonS = 2.0;
constexpr int kMaxBounces = 4;
constexpr double kBeforeGoalM = 0.5;  // only a puck so near to a goal can have vanished in it

}  // namespace

GameObserver::Goal GameObserver::goal_ahead(const PuckTrack& track) const {
  PuckTrack at = track;
  double left_s = kHorizonS;
  for (int bounces = 0; bounces <= kMaxBounces && left_s > 0; ++bounces) {
    const PuckMotion::Leg leg = motion_.next_leg(at, left_s);
    if (leg.end == PuckMotion::LegEnd::kTimeUp) return Goal::kNone;
    if (leg.end == PuckMotion::LegEnd::kGoal) {
      const bool near = leg.track.state.position.x_m < motion_.table().length_m / 2;
      return near ? Goal::kRobots : Goal::kOpponents;
    }
    at = leg.track;
    left_s -= leg.duration_s;
  }
  return Goal::kNone;
}

void GameObserver::enter(GamePhase phase, Timestamp t) {
  if (phase == belief_.phase) return;
  belief_.phase = phase;
  belief_.phase_since = t;
}

void GameObserver::end_rally() {
  belief_.rally_hits = 0;
  heading_ = Heading::kNone;
  shot_open_ = false;
  aimed_since_.reset();
  astray_since_.reset();
}

void GameObserver::follow_heading(double vx_m_s) {
  const Heading before = heading_;
  if (vx_m_s < -kHeadingMS) heading_ = Heading::kToRobot;
  if (vx_m_s > kHeadingMS) heading_ = Heading::kToOpponent;
  if (heading_ == before) return;
  ++belief_.rally_hits;
  belief_.longest_rally = std::max(belief_.longest_rally, belief_.rally_hits);
  if (heading_ == Heading::kToOpponent && shot_open_) {
    ++belief_.saves;
    shot_open_ = false;
  }
  aimed_since_.reset();
  astray_since_.reset();
}

void GameObserver::follow_shot(Timestamp t, const PuckTrack& track) {
  const bool aimed = heading_ == Heading::kToRobot && goal_ahead(track) == Goal::kRobots;
  if (aimed) {
    astray_since_.reset();
    if (!aimed_since_) aimed_since_ = t;
    if (!shot_open_ && t - *aimed_since_ >= kSureUs) {
      ++belief_.shots;
      shot_open_ = true;
    }
    return;
  }
  aimed_since_.reset();
  if (!shot_open_) return;
  if (!astray_since_) astray_since_ = t;
  if (t - *astray_since_ < kSureUs) return;
  // It left its way beside the mallet: turned aside. Elsewhere the first prediction was wrong.
  const TableGeometry& table = motion_.table();
  const double reach_m = table.robot_line_x_m + 3 * (table.mallet_radius_m + table.puck_radius_m);
  if (track.state.position.x_m < reach_m) ++belief_.saves;
  shot_open_ = false;
}

void GameObserver::see(Timestamp t, const PuckTrack& track) {
  const auto& velocity = track.state.velocity;
  if (belief_.phase == GamePhase::kGoal) end_rally();
  last_seen_ = t;
  last_track_ = track;

  follow_heading(velocity.x_m_s);
  follow_shot(t, track);
  if (std::hypot(velocity.x_m_s, velocity.y_m_s) >= kSlowMS) {
    slow_since_.reset();
  } else if (!slow_since_) {
    slow_since_ = t;
  }

  if (slow_since_ && t - *slow_since_ >= kStuckUs) {
    end_rally();
    enter(GamePhase::kPuckStuck, t);
  } else if (shot_open_) {
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
  const Goal goal = goal_ahead(last_track_);
  if (goal == Goal::kRobots && x_m < kBeforeGoalM) {
    ++belief_.goals_against;
    enter(GamePhase::kGoal, t);
  } else if (goal == Goal::kOpponents && x_m > length_m - kBeforeGoalM) {
    ++belief_.goals_for;
    enter(GamePhase::kGoal, t);
  } else {
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
