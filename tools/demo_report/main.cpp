#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>

#include "tools/command_line/run_tool.h"
#include "tools/demo_report/demo_figures.h"
#include "tools/demo_report/game_log.h"

namespace {

struct Options {
  std::filesystem::path game;
  std::filesystem::path replay;
  std::filesystem::path json;
};

// 0 when the puck was tracked, 1 when it never was.
int report(const Options& options) {
  const puck::GameLog game = puck::read_game_log(options.game);
  std::optional<puck::GameLog> replay;
  if (!options.replay.empty()) replay = puck::read_game_log(options.replay);
  const puck::DemoFigures figures = puck::demo_figures(game, replay ? &*replay : nullptr);
  puck::print(figures);
  if (!options.json.empty()) puck::write_json(figures, options.json);
  if (game.rejected > 0) {
    std::fprintf(stderr, "puck-demo-report: %lld malformed messages in %s\n",
                 static_cast<long long>(game.rejected), options.game.c_str());
  }
  const bool tracked = std::any_of(
      game.estimates.begin(), game.estimates.end(),
      [](const auto& estimate) { return estimate.state == puck::puck_estimate_t::STATE_TRACKING; });
  if (!tracked) std::fprintf(stderr, "puck-demo-report: nothing was tracked\n");
  return tracked ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Says what happened in a game, from the log that puck-logger wrote.");
  Options options;
  app.add_option("LOG", options.game, "of the game")->required();
  app.add_option("--replay", options.replay, "log of a tracker fed with the game's events");
  app.add_option("--json", options.json, "write the figures here");
  return puck::run_tool(app, argc, argv, "puck-demo-report", [&] { return report(options); });
}
