// What is taken for the puck first: puck-evaluate on the start of games.
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

double mean_px(const TemporaryFolder& folder, std::vector<std::string> options) {
  options.insert(options.end(),
                 {"--size-model", source_folder() / "config/calibration/simulated_size.toml"});
  return evaluate_game(folder, options)["mean_px"];
}

// Development games in which that goes wrong without the ingredient.
TEST_CASE("under a turning head a faint puck is found before what slides along a tile's edges") {
  constexpr double kElsewhere_px = 100;
  int found_elsewhere = 0;
  int slid_elsewhere = 0;
  for (const char* seed : {"11", "14", "23", "36"}) {
    const TemporaryFolder folder;
    run_tool("puck-simulate", folder,
             {"--output", "game", "--seed", seed, "--seconds", "0.5", "--moving", "--scene",
              source_folder() / "tools/compare/scenes/low_contrast_5_m_s.toml"});
    const double found_px = mean_px(folder, {});
    const double slid_px = mean_px(folder, {"--without", "own-motion"});
    MESSAGE("mean error of the first half second, px: " << found_px << ", without own-motion "
                                                        << slid_px);
    found_elsewhere += found_px > kElsewhere_px;
    slid_elsewhere += slid_px > kElsewhere_px;
  }
  CHECK(found_elsewhere <= 1);
  CHECK(slid_elsewhere > found_elsewhere);
}

}  // namespace
}  // namespace puck
