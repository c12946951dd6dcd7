#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "tools/command_line/flush_stdout.h"
#include "tools/command_line/run_tool.h"
#include "tools/demo_report/demo_figures.h"
#include "tools/demo_report/demo_table.h"
#include "tools/demo_report/game_log.h"
#include "tools/demo_report/live_game.h"

namespace {

struct Options {
  std::filesystem::path game;
  std::filesystem::path replay;
  std::filesystem::path json;
  std::string live_url;
  int seconds = 20;
};

// Prints a message if the puck was never tracked.
bool is_tracked(const puck::GameLog& log, const std::filesystem::path& path) {
  const bool tracked = std::any_of(
      log.estimates.begin(), log.estimates.end(),
      [](const auto& estimate) { return estimate.state == puck::puck_estimate_t::STATE_TRACKING; });
  if (!tracked) {
    std::fprintf(stderr, "puck-demo-report: %s: the puck was never tracked\n", path.c_str());
  }
  return tracked;
}

// False when the puck was never tracked, in the game or its replay.
bool report(const Options& options) {
  const puck::GameLog game = puck::read_game_log(options.game);
  std::optional<puck::GameLog> replay;
  if (!options.replay.empty()) replay = puck::read_game_log(options.replay);
  const puck::DemoFigures figures = puck::demo_figures(game, replay ? &*replay : nullptr);
  std::fputs(puck::demo_table(figures).c_str(), stdout);
  puck::flush_stdout();
  if (!options.json.empty()) puck::write_json(figures, options.json);
  if (game.rejected > 0) {
    std::fprintf(stderr, "puck-demo-report: %s: %lld malformed messages\n", options.game.c_str(),
                 static_cast<long long>(game.rejected));
  }
  return is_tracked(game, options.game) && (!replay || is_tracked(*replay, options.replay));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Reports a game: from the log that puck-logger wrote, or while it is played.");
  Options options;
  auto* log = app.add_option("LOG", options.game, "Log of the game");
  app.add_option("--replay", options.replay, "Log of a tracker that was fed with the game's events")
      ->needs(log);
  app.add_option("--json", options.json, "Write the figures to this file")->needs(log);
  auto* live = app.add_option("--live", options.live_url,
                              "LCM URL of a game: print its progress while it is played")
                   ->excludes(log);
  app.add_option("--seconds", options.seconds, "With --live: duration, s")
      ->check(CLI::Range(1, 99'999))
      ->capture_default_str()
      ->needs(live);
  app.parse_complete_callback([&] {
    if (log->count() + live->count() == 0) throw CLI::RequiredError("LOG or --live");
  });
  return puck::run_tool(app, argc, argv, "puck-demo-report", [&] {
    if (options.live_url.empty()) return report(options) ? 0 : 1;
    puck::watch_game(options.live_url, options.seconds);
    return 0;
  });
}
