#include "tools/demo_report/demo_figures.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

/// What is printed meanwhile goes to a file.
class CapturedOutput {
 public:
  explicit CapturedOutput(const std::filesystem::path& file) : file_(file) {
    std::fflush(stdout);
    before_ = dup(STDOUT_FILENO);
    REQUIRE(before_ >= 0);
    REQUIRE(std::freopen(file.c_str(), "w", stdout) != nullptr);
  }
  CapturedOutput(const CapturedOutput&) = delete;
  CapturedOutput& operator=(const CapturedOutput&) = delete;
  ~CapturedOutput() {
    std::fflush(stdout);
    dup2(before_, STDOUT_FILENO);
    close(before_);
  }

  std::string text() const {
    std::fflush(stdout);
    std::ostringstream text;
    text << std::ifstream(file_).rdbuf();
    return text.str();
  }

 private:
  std::filesystem::path file_;
  int before_ = -1;
};

struct Printed {
  std::string text;
  nlohmann::json json;
};

Printed printed(const GameLog& game) {
  const TemporaryFolder folder;
  const DemoFigures figures = demo_figures(game, nullptr);
  write_json(figures, folder / "figures.json");
  const CapturedOutput output(folder / "printed");
  print(figures);
  return {output.text(), nlohmann::json::parse(std::ifstream(folder / "figures.json"))};
}

}  // namespace

TEST_CASE("a report says when a counter that it takes for 0 may have had no room in STATUS") {
  GameLog game;
  game.counters["puck-arm"] = {{"messages_received", 7}};
  Printed report = printed(game);
  CHECK(report.text.find("had no room") == std::string::npos);
  CHECK(report.json["counters_left_out"] == 0);
  game.counters["puck-arm"]["counters_left_out"] = 3;
  game.counters["puck-tracker"]["counters_left_out"] = 2;
  report = printed(game);
  CHECK(report.text.find("5 counters had no room in STATUS: what is 0 here may be more") !=
        std::string::npos);
  CHECK(report.json["counters_left_out"] == 5);
  CHECK(report.json["messages_received"] == 7);
}

TEST_CASE("a report says what became of shots that were neither saved nor went in") {
  const auto told = [](int shots, int saves, int goals_against) {
    GameLog game;
    game.last_truth.emplace();
    game.last_truth->shots = shots;
    game.last_truth->saves = saves;
    game.last_truth->goals_against = goals_against;
    return printed(game).text;
  };
  CHECK(told(9, 6, 1).find("neither saved nor in: 2, under way at the end") != std::string::npos);
  CHECK(told(8, 7, 1).find("neither saved") == std::string::npos);
  // Saved, and in by a rail.
  CHECK(told(1, 1, 1).find("neither saved") == std::string::npos);
}

}  // namespace puck
