// Loss of accuracy by lost packets of events: puck-evaluate --drop-packets.
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

using Json = nlohmann::json;

Json evaluate(const TemporaryFolder& folder, const std::string& percent, const std::string& seed) {
  return evaluate_game(folder, {"--drop-packets", percent, "--drop-seed", seed});
}

double mean_over_seeds(const TemporaryFolder& folder, const std::string& percent, const char* key) {
  double sum = 0;
  for (const char* seed : {"1", "2", "3"}) {
    sum += evaluate(folder, percent, seed)[key].get<double>();
  }
  return sum / 3;
}

/// Options of puck-simulate, and whether the mean error is held to 10 %, too.
struct SimulatedGame {
  std::vector<std::string> options;
  bool holds_mean = false;
};

// In the moving game the head's motion keeps the puck at one place in the image for 40 ms. The
// track is then off by 6 to 16 px, with or without packet loss, and the time until it is found
// again depends on single events. That dominates the mean of four seconds, so the 10 % apply to the
// median there, and the lost share must not grow.
TEST_CASE(
    "the loss of 1 % of the packets costs less than 10 % of accuracy, camera still or moving" *
    doctest::test_suite("deep")) {
  const std::vector<SimulatedGame> games{
      {.options = {"--seed", "1", "--seconds", "8"}, .holds_mean = true},
      {.options = {"--seed", "2", "--seconds", "4", "--moving"}}};
  for (const auto& [options, holds_mean] : games) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"--output", "game"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    run_tool("puck-simulate", folder, arguments);
    const Json whole = evaluate(folder, "0", "1");
    const double whole_px = whole["median_px"];
    const double one_px = mean_over_seeds(folder, "1", "median_px");
    MESSAGE("median error, px: " << whole_px << ", without 1 % of the packets " << one_px);
    const double whole_mean_px = whole["mean_px"];
    const double one_mean_px = mean_over_seeds(folder, "1", "mean_px");
    MESSAGE("mean error, px: " << whole_mean_px << ", without 1 % " << one_mean_px
                               << ", without 5 % " << mean_over_seeds(folder, "5", "mean_px"));
    CHECK(whole["estimates"] > 2000);
    CHECK(one_px < 1.1 * whole_px);
    if (holds_mean) CHECK(one_mean_px < 1.1 * whole_mean_px);
    // The limit is one that a loss can exceed.
    CHECK(evaluate(folder, "30", "1")["median_px"].get<double>() > 1.1 * whole_px);
    CHECK(mean_over_seeds(folder, "1", "lost_percent") < whole["lost_percent"].get<double>() + 0.5);
    // The requested number, the same for the same seed.
    Json some = evaluate(folder, "5", "1");
    const double left = some["events"].get<double>() / whole["events"].get<double>();
    CHECK(left == doctest::Approx(0.95).epsilon(0.01));
    CHECK(evaluate(folder, "5", "2")["events"] != some["events"]);
    Json again = evaluate(folder, "5", "1");
    for (Json* json : {&some, &again}) json->erase("cpu_us_per_ms");
    CHECK(again == some);
  }
}

}  // namespace
}  // namespace puck
