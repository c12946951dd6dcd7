#include "common/play/game_observer.h"

#include <cmath>

#include <doctest/doctest.h>

namespace puck {
namespace {

// The covariance of a track that has been followed for a while.
const Matrix4 kSure = diagonal(1e-6, 1e-6, 1e-4, 1e-4);

// Shows the observer a puck once a millisecond.
class Game {
 public:
  void put(double x, double y, double vx, double vy) { puck_ = {{{x, y}, {vx, vy}}, {}}; }
  void glide(int ms) {
    for (int i = 0; i < ms; ++i) {
      t_ = t_ + 1000;
      puck_ = {motion_.advance(puck_, 0.001).track.state, kSure};
      observer.see(t_, puck_);
    }
  }
  void hide(int ms) {
    for (int i = 0; i < ms; ++i) observer.miss(t_ = t_ + 1000);
  }
  const PuckState& puck() const { return puck_.state; }
  const GameBelief& belief() const { return observer.belief(); }

 private:
  PuckMotion motion_{TableGeometry{}};
  Timestamp t_{0};
  PuckTrack puck_;

 public:
  GameObserver observer{motion_};
};

TEST_CASE("A puck towards the robot's goal is one shot; turned back, one save") {
  Game game;
  game.put(1.8, 0.1, -2, -0.1);
  game.glide(300);
  CHECK(game.belief().phase == GamePhase::kShotAtRobot);
  CHECK(game.belief().shots == 0);
  game.glide(200);
  CHECK(game.belief().shots == 1);
  CHECK(game.belief().saves == 0);
  game.put(0.3, 0.02, 2, 0.3);
  game.glide(100);
  CHECK(game.belief().shots == 1);
  CHECK(game.belief().saves == 1);
  CHECK(game.belief().phase == GamePhase::kRally);
  CHECK(game.belief().rally_hits == 2);
}

TEST_CASE("A shot deflected by the mallet to the goal's side is a save") {
  Game game;
  game.put(1.8, 0, -2, 0);
  game.glide(700);
  CHECK(game.belief().shots == 1);
  game.put(0.25, 0.05, -0.5, 2);
  game.glide(40);
  CHECK(game.belief().saves == 1);
}

TEST_CASE("A puck that would miss the goal is no shot, and its return from the rail no save") {
  Game game;
  game.put(1.8, 0.45, -2, 0);
  game.glide(1500);
  CHECK(game.belief().shots == 0);
  CHECK(game.belief().saves == 0);
  CHECK(game.belief().rally_hits == 1);
}

TEST_CASE("A puck that returns from the opponent's end rail by itself is no shot") {
  Game game;
  game.put(1.5, 0.32, 3, -0.34);
  game.glide(1100);
  CHECK(game.puck().velocity.x_m_s < -1.5);
  CHECK(std::abs(game.puck().position.y_m) < 0.1);
  CHECK(game.belief().phase == GamePhase::kRally);
  CHECK(game.belief().rally_hits == 1);
  CHECK(game.belief().shots == 0);
}

TEST_CASE("A puck served out of the opponent's goal is no shot") {
  Game game;
  game.put(2.1, 0, -1.5, 0);
  game.glide(800);
  CHECK(game.belief().phase == GamePhase::kWaiting);
  CHECK(game.belief().shots == 0);
}

TEST_CASE("A shot that grazes a goal post and goes in is no save") {
  Game game;
  game.put(1.6, 0.172, -3, 0);
  game.glide(1000);
  CHECK(game.puck().position.x_m < 0.001);
  CHECK(game.belief().shots == 1);
  CHECK(game.belief().saves == 0);
}

TEST_CASE("A puck seen in the goal before it vanishes is one goal, and no save") {
  for (const bool is_touched : {false, true}) {
    CAPTURE(is_touched);
    Game game;
    game.put(1.8, 0, -4, 0);
    game.glide(380);
    if (is_touched) {
      game.put(0.25, 0, -3, 0.1);
      game.glide(80);
    } else {
      game.glide(60);
    }
    CHECK(game.belief().shots == 1);
    game.put(-0.03, 0.05, 0, 0);
    game.glide(10);
    game.hide(100);
    game.put(-0.02, 0.05, 0.4, 0);
    game.glide(20);
    game.hide(250);
    CHECK(game.belief().phase == GamePhase::kGoal);
    game.put(-0.02, 0.05, 0, 0);
    game.glide(20);
    game.hide(250);
    CHECK(game.belief().goals_against == 1);
    CHECK(game.belief().saves == 0);
  }
}

TEST_CASE("A puck served out of a goal and lost there is no goal") {
  for (const double x_m : {2.1, -0.04}) {
    CAPTURE(x_m);
    Game game;
    game.put(x_m, 0, x_m > 0 ? -1.5 : 1.5, 0);
    game.glide(15);
    game.hide(250);
    CHECK(game.belief().goals_for == 0);
    CHECK(game.belief().goals_against == 0);
  }
}

TEST_CASE("A soft hit that deflects an approaching puck makes it a shot") {
  Game game;
  game.put(1.9, 0.4, -1.5, 0);
  game.glide(100);
  CHECK(game.belief().phase == GamePhase::kRally);
  game.put(1.7, 0.4, -1.7, -0.4);
  game.glide(800);
  CHECK(game.belief().shots == 1);
  CHECK(game.belief().rally_hits == 2);
}

TEST_CASE("A shot with a hidden hit counts when it is seen late") {
  Game game;
  game.put(1.7, 0, 0, 0);
  game.glide(200);
  game.hide(100);
  game.put(0.9, 0, -8, 0);
  game.glide(40);
  CHECK(game.belief().shots == 1);
  game.put(0.3, 0, 5, 0);
  game.glide(20);
  CHECK(game.belief().saves == 1);
}

TEST_CASE("A puck that vanishes on its way into a goal is a goal, once each time") {
  Game game;
  game.put(1.0, 0, -3, 0);
  game.glide(200);
  game.hide(1000);
  CHECK(game.belief().phase == GamePhase::kGoal);
  CHECK(game.belief().goals_against == 1);
  CHECK(game.belief().goals_for == 0);
  game.put(1.2, 0, 3, 0);
  game.glide(200);
  CHECK(game.belief().phase == GamePhase::kRally);
  CHECK(game.belief().rally_hits == 1);
  game.hide(1000);
  CHECK(game.belief().goals_for == 1);
  CHECK(game.belief().goals_against == 1);
}

TEST_CASE("A puck that vanishes elsewhere is out of view") {
  Game game;
  game.hide(500);
  CHECK(game.belief().phase == GamePhase::kWaiting);
  game.put(1.0, 0.4, 0, -0.5);
  game.glide(100);
  game.hide(500);
  CHECK(game.belief().phase == GamePhase::kPuckOutOfView);
  CHECK(game.belief().goals_against + game.belief().goals_for == 0);
}

TEST_CASE("A puck that rests for two seconds is stuck and ends the rally") {
  Game game;
  game.put(1.0, 0.3, -1, 0);
  game.glide(100);
  game.put(0.9, 0.3, 0, 0);
  game.glide(1990);
  CHECK(game.belief().phase == GamePhase::kRally);
  game.glide(20);
  CHECK(game.belief().phase == GamePhase::kPuckStuck);
  CHECK(game.belief().rally_hits == 0);
  CHECK(game.belief().longest_rally == 2);  // what stopped it was a hit, too
}

}  // namespace
}  // namespace puck
