#include "tools/demo_report/demo_table.h"

#include <sstream>
#include <string>

#include <doctest/doctest.h>

namespace puck {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

DemoFigures game_of(int shots, int saves, int goals_against) {
  DemoFigures figures;
  figures.shots = shots;
  figures.saves = saves;
  figures.goals_against = goals_against;
  return figures;
}

}  // namespace

TEST_CASE("the table fits a terminal of 80 columns and ends with a sentence on the game") {
  DemoFigures figures = game_of(9, 8, 1);
  figures.events_sent = 123'456'789;
  figures.events_lost = 0;
  figures.mean_px = 0.084;
  figures.lost_percent = 0.014;
  figures.packet_to_estimate = {91, 767, 44'404};
  const std::string table = demo_table(figures);
  std::istringstream lines(table);
  std::string last;
  for (std::string line; std::getline(lines, line); last = line) CHECK(last.size() <= 80);
  CHECK(
      last ==
      "The robot saved 8 of 9 shots; the tracker was 0.08 px off on average and lost the puck for "
      "0.01 % of the time; no event was lost.");
  CHECK(contains(table,
                 "  packet received to estimate published          91        767      44404 us"));
}

TEST_CASE("the sentence names failures, and omits unknown figures") {
  DemoFigures figures;
  figures.estimates = 1;
  figures.events_lost = 12;
  CHECK(contains(demo_table(figures), "\nThe tracker made 1 estimate; 12 events were lost.\n"));
  CHECK(contains(demo_table(game_of(0, 0, 0)), "\nThere was no shot at the robot's goal; the "));
  CHECK(contains(demo_table(figures), "mean distance to the recorded estimates          -\n"));
}

TEST_CASE("the table warns of counters that did not fit into STATUS") {
  DemoFigures figures;
  CHECK_FALSE(contains(demo_table(figures), "did not fit"));
  figures.bus.left_out = 5;
  CHECK(contains(demo_table(figures), "5 counters did not fit into STATUS: a 0 here may be more"));
}

TEST_CASE("the table counts shots that were neither saved nor goals") {
  CHECK(contains(demo_table(game_of(9, 6, 1)), "2 shots neither saved nor in"));
  CHECK_FALSE(contains(demo_table(game_of(8, 7, 1)), "neither saved"));
  // Saved, and in the goal by a rail.
  CHECK_FALSE(contains(demo_table(game_of(1, 1, 1)), "neither saved"));
  CHECK(contains(demo_table(game_of(1, 1, 1)), "1 goal besides missed shots: a saved puck"));
  CHECK_FALSE(contains(demo_table(game_of(8, 7, 1)), "besides missed shots"));
}

TEST_CASE("the table reports a difference between the bridge's and the simulated table's counts") {
  DemoFigures figures = game_of(9, 9, 0);
  CHECK_FALSE(contains(demo_table(figures), "bridge counted"));
  figures.believed_shots = 9;
  figures.believed_saves = 9;
  figures.believed_goals_against = 0;
  CHECK_FALSE(contains(demo_table(figures), "bridge counted"));
  figures.believed_goals_against = 1;
  CHECK(contains(
      demo_table(figures),
      "the bridge counted differently, from estimates: 9 shots, 9 saves, 1 goal against\n"));
}

}  // namespace puck
