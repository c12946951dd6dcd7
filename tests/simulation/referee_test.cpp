#include "common/simulation/referee.h"

#include <doctest/doctest.h>

#include "common/simulation/table_game.h"

namespace puck {
namespace {

const DiscState kResting{{1.6, 0}, {0, 0}};
const DiscState kAtGoal{{1.6, 0}, {-2, 0}};
const DiscState kBesideGoal{{1.6, 0.4}, {-2, 0}};
const DiscState kAtGoalNear{{0.3, 0}, {-2, 0}};
const DiscState kTurnedAway{{0.3, 0}, {1.6, 0}};

Referee referee() { return Referee(PuckPhysics({}, {})); }

// A hit at `t_s` and its judgement 20 ms later.
void opponent_hits(Referee& judge, const DiscState& after, double t_s) {
  judge.opponent_touched(kResting, t_s);
  judge.watch(after, t_s + 0.02);
}

}  // namespace

TEST_CASE("A hit towards the goal is a shot, one beside it is not") {
  Referee judge = referee();
  opponent_hits(judge, kAtGoal, 1);
  CHECK(judge.counts() == GameCounts{1, 0, 0, 0});
  opponent_hits(judge, kBesideGoal, 2);
  CHECK(judge.counts() == GameCounts{1, 0, 0, 0});
}

TEST_CASE("Contacts within 10 ms are one hit, judged once") {
  Referee judge = referee();
  judge.opponent_touched(kResting, 1.000);
  judge.watch(kAtGoal, 1.005);
  CHECK(judge.counts().shots == 0);
  judge.opponent_touched(kAtGoal, 1.006);
  judge.watch(kAtGoal, 1.012);
  CHECK(judge.counts().shots == 0);
  judge.watch(kAtGoal, 1.017);
  judge.watch(kAtGoal, 1.018);
  CHECK(judge.counts().shots == 1);
}

TEST_CASE("A shot that the robot turns away is one save") {
  Referee judge = referee();
  opponent_hits(judge, kAtGoal, 1);
  judge.robot_touched(kAtGoalNear, 2);
  judge.watch(kTurnedAway, 2.02);
  CHECK(judge.counts() == GameCounts{1, 1, 0, 0});
  judge.robot_touched(kAtGoalNear, 3);
  judge.watch(kTurnedAway, 3.02);
  CHECK(judge.counts() == GameCounts{1, 1, 0, 0});
}

TEST_CASE("A shot that the robot only brushes, and a touch without a shot, are no saves") {
  Referee judge = referee();
  opponent_hits(judge, kAtGoal, 1);
  judge.robot_touched(kAtGoalNear, 2);
  judge.watch(kAtGoalNear, 2.02);
  CHECK(judge.counts() == GameCounts{1, 0, 0, 0});
  judge.puck_left({{-0.04, 0}, {-2, 0}}, GoalEntered::kRobots);
  CHECK(judge.counts() == GameCounts{1, 0, 1, 0});
  opponent_hits(judge, kBesideGoal, 4);
  judge.robot_touched(kAtGoalNear, 5);
  judge.watch(kTurnedAway, 5.02);
  CHECK(judge.counts() == GameCounts{1, 0, 1, 0});
}

TEST_CASE("A shot that the opponent deflects himself is neither a save nor a goal") {
  Referee judge = referee();
  opponent_hits(judge, kAtGoal, 1);
  opponent_hits(judge, kBesideGoal, 2);
  judge.robot_touched(kBesideGoal, 3);
  judge.watch(kTurnedAway, 3.02);
  CHECK(judge.counts() == GameCounts{1, 0, 0, 0});
}

TEST_CASE("A shot that is in before its hit is over still counts") {
  Referee judge = referee();
  judge.opponent_touched(kResting, 1);
  judge.puck_left({{-0.04, 0}, {-15, 0}}, GoalEntered::kRobots);
  CHECK(judge.counts() == GameCounts{1, 0, 1, 0});
}

TEST_CASE("Goals count for the right player") {
  Referee judge = referee();
  judge.puck_left({{2.2, 0}, {2, 0}}, GoalEntered::kOpponents);
  judge.puck_left({{1, 0}, {0, 0}}, GoalEntered::kNone);
  CHECK(judge.counts() == GameCounts{0, 0, 0, 1});
}

TEST_CASE("In a game a robot in the way saves, and an absent one does not") {
  SimulationParams params;
  const auto play = [&](double robot_y_m, const DiscState& shot) {
    TableGame game(params);
    game.set_robot_mallet(robot_y_m);
    for (int i = 0; i < 40'000; ++i) game.step();
    const GameCounts before = game.counts();
    game.place_puck(shot);
    int goals = 0;
    for (int i = 0; i < 40'000 && goals == 0; ++i) {
      game.step();
      goals = game.counts().goals_against - before.goals_against;
    }
    return goals;
  };
  CHECK(play(0.0, {{1, 0}, {-3, 0}}) == 0);
  CHECK(play(0.3, {{1, 0}, {-3, 0}}) == 1);
}

TEST_CASE("Over a long game shots end in saves and goals") {
  SimulationParams params;
  params.game.shot_speed_max_m_s = 8;
  params.autonomous_robot = true;
  params.arm.max_speed_m_s = 0.4;
  TableGame game(params);
  for (int i = 0; i < 120 * 40'000; ++i) game.step();
  const GameCounts counts = game.counts();
  CHECK(counts.shots > 20);
  CHECK(counts.saves > 5);
  CHECK(counts.goals_against > 2);
  CHECK(counts.saves <= counts.shots);
  // There are goals without a shot, too: a saved puck can still find its way in by a rail.
  CHECK(counts.saves + counts.goals_against >= counts.shots - 1);
}

TEST_CASE("A puck out of every player's reach is served again") {
  SimulationParams params;
  TableGame game(params);
  game.place_puck({{0.5, 0.5}, {0, 0}});
  bool was_off = false;
  bool is_back = false;
  for (int i = 0; i < 4 * 40'000; ++i) {
    game.step();
    was_off |= !game.puck().has_value();
    is_back |= was_off && game.puck() && game.puck()->position.x_m > 1.2;
  }
  CHECK(was_off);
  CHECK(is_back);
}

}  // namespace puck
