#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/containers/scenarios.h"
#include "tools/command_line/run_tool.h"
#include "tools/demo_report/game_log.h"

namespace {

using puck::GameRecord;
using puck::Verdict;

struct Options {
  std::string scenario;
  std::string title;
  std::filesystem::path log;
  std::string prefix;
  double percent = 0;
  std::vector<std::tuple<std::string, std::int64_t, std::int64_t>> memory;  // As MemoryUse.
  std::filesystem::path replay;
};

using Judge = std::function<void(const GameRecord&, const Options&, Verdict&)>;

// A judge of the game alone, without options.
Judge of(void (*judge)(const GameRecord&, Verdict&)) {
  return
      [judge](const GameRecord& game, const Options&, Verdict& verdict) { judge(game, verdict); };
}

void judge_intruder(const GameRecord& game, const Options& options, Verdict& verdict) {
  std::vector<puck::MemoryUse> memory;
  for (const auto& [service, before_kb, after_kb] : options.memory) {
    memory.push_back({service, before_kb, after_kb});
  }
  puck::judge_intruder(game, memory, verdict);
}

const std::map<std::string, Judge> kJudges{
    {"game", of([](const GameRecord&, Verdict&) {})},
    {"nothing-lost", of(puck::judge_nothing_lost)},
    {"frame-loss",
     [](const GameRecord& game, const Options& options, Verdict& verdict) {
       puck::judge_frame_loss(game, options.percent, verdict);
     }},
    {"narrow-link", of(puck::judge_narrow_link)},
    {"killed-tracker", of(puck::judge_killed_tracker)},
    {"frozen-bridge", of(puck::judge_frozen_bridge)},
    {"cut-off-tracker", of(puck::judge_cut_off_tracker)},
    {"neighbour", of(puck::judge_neighbour)},
    {"intruder", &judge_intruder},
    {"replay", of(puck::judge_replay)},
};

GameRecord read_game(const Options& options) {
  const puck::GameLog game = puck::read_game_log(options.log, options.prefix);
  std::optional<puck::GameLog> replay;
  if (!options.replay.empty()) replay = puck::read_game_log(options.replay, options.prefix);
  return {puck::read_bus_log(options.log, options.prefix),
          puck::demo_figures(game, replay ? &*replay : nullptr)};
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

// Lost on the way to the tracker, in all its sessions, by its own count.
std::string events_lost(const GameRecord& game) {
  std::int64_t lost = 0;
  for (const puck::ServiceRun& run : puck::runs_of(game.log, "puck-tracker")) {
    const auto count = run.counter("events_lost");
    if (!count) return "?";
    lost += *count;
  }
  return std::to_string(lost);
}

// A line of the table; tests/containers/run.sh prints its head.
void print_row(const Options& options, const GameRecord& game, const Verdict& verdict) {
  const std::string lost = events_lost(game);
  const puck::DemoFigures& f = game.figures;
  std::printf("%-31s %8lld %8s %6.0f %6.2f %6.2f %5lld %5lld  %-4s  %s\n", options.title.c_str(),
              static_cast<long long>(f.events_sent.value_or(0)), lost.c_str(),
              f.estimate_rate_hz.value_or(0), f.median_px.value_or(0), f.mean_px.value_or(0),
              static_cast<long long>(f.shots.value_or(0)),
              static_cast<long long>(f.saves.value_or(0)), verdict.passed() ? "pass" : "FAIL",
              joined(verdict.notes()).c_str());
  for (const std::string& complaint : verdict.complaints()) {
    std::printf("    wrong: %s\n", complaint.c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Judges a game that was played between containers, from the log of its bus.",
               "puck-container-verdict");
  Options options;
  app.add_option("SCENARIO", options.scenario, "what happened")
      ->required()
      ->check(CLI::IsMember(kJudges));
  app.add_option("LOG", options.log, "of the game")->required();
  app.add_option("--title", options.title, "first column of the table; default: the scenario");
  app.add_option("--prefix", options.prefix, "of the channels");
  app.add_option("--percent", options.percent, "for frame-loss: how many were to be lost");
  app.add_option("--memory", options.memory,
                 "for intruder: what a service had in use before the intruder came once more, and "
                 "after; may be repeated")
      ->type_name("SERVICE KB KB");
  app.add_option("--replay", options.replay, "for replay: log of the tracker fed from LOG");
  return puck::run_tool(app, argc, argv, "puck-container-verdict", [&] {
    if (options.title.empty()) options.title = options.scenario;
    const GameRecord game = read_game(options);
    Verdict verdict;
    puck::judge_game(game, verdict);
    kJudges.at(options.scenario)(game, options, verdict);
    print_row(options, game, verdict);
    return verdict.passed() ? 0 : 1;
  });
}
