#include "tools/demo_report/demo_figures.h"

#include <cstdint>
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

TEST_CASE("a replay is compared where the truth has the puck in sight") {
  GameLog game;
  GameLog replay;
  for (std::int64_t us = 0; us <= 4'000; us += 1'000) {
    const bool is_hidden = us > 2'000;
    game.truth.push_back({.time = {us}, .centre = {100, 80}, .visible = is_hidden ? 0.0 : 1.0});
    puck_estimate_t estimate{};
    estimate.sensor_us = us;
    estimate.flags = puck_estimate_t::FLAG_POSITION;
    game.estimates.push_back(estimate);
    estimate.x_px = is_hidden ? 300 : 1;
    replay.estimates.push_back(estimate);
  }
  CHECK(demo_figures(game, &replay).replay_mean_difference_px == doctest::Approx(1));
  game.truth.clear();
  CHECK(demo_figures(game, &replay).replay_mean_difference_px == doctest::Approx(120.6));
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
