#include "tools/demo_report/demo_figures.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"

namespace puck {

TEST_CASE("the figures of all services are summed, and figures without a log are null") {
  const TemporaryFolder folder;
  GameLog game;
  game.counters["puck-arm"] = {{"messages_received", 7}, {"counters_left_out", 3}};
  game.counters["puck-tracker"] = {{"messages_received", 5}, {"counters_left_out", 2}};
  write_json(demo_figures(game, nullptr), folder / "figures.json");
  const auto json = nlohmann::json::parse(std::ifstream(folder / "figures.json"));
  CHECK(json["messages_received"] == 12);
  CHECK(json["counters_left_out"] == 5);
  CHECK(json["shots"].is_null());
  CHECK(json["packet_to_estimate_p50_us"].is_null());
}

TEST_CASE("a file of figures is replaced as a whole; on failure none is left") {
  const TemporaryFolder folder;
  std::ofstream(folder / "figures.json") << "old";
  write_json({}, folder / "figures.json");
  CHECK(nlohmann::json::parse(std::ifstream(folder / "figures.json"))["estimates"] == 0);
  std::filesystem::create_directory(folder / "a_folder");
  CHECK_THROWS_AS(write_json({}, folder / "a_folder"), std::runtime_error);
  CHECK_THROWS_AS(write_json({}, folder / "nowhere" / "figures.json"), std::runtime_error);
  const auto entries = std::filesystem::directory_iterator(folder.path());
  CHECK(std::distance(begin(entries), end(entries)) == 2);
}

}  // namespace puck
