// Games without a fault, except for the network's.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/containers/scenarios.h"

namespace puck {
namespace {

constexpr std::array kServices{"puck-camera", "puck-tracker", "puck-bridge", "puck-arm",
                               "puck-logger"};

// UDP payload of an Ethernet frame.
constexpr std::size_t kFrameBytes = 1472;
// Of Ethernet, IP and UDP, before each datagram.
constexpr std::size_t kHeaderBytes = 42;

// Far above the tracker's error, which other tests bound, and far below chance. The median, because
// an estimate without a position, as of a newly started tracker, counts as 100 px in the mean.
constexpr double kMedianPx = 2;
constexpr double kLostPercent = 50;

constexpr double kReplayPx = 0.5;
// In small processes a few pages are more than 10 %.
constexpr double kMemoryPercent = 10;
constexpr double kMemoryKb = 1024;

bool was_commanded(const BusLog& log) {
  return std::any_of(log.arm_states.begin(), log.arm_states.end(),
                     [](const auto& heard) { return heard.message.command_session != 0; });
}

void demand_one_life(const BusLog& log, Verdict& verdict) {
  for (const std::string service : kServices) {
    const std::size_t lives = runs_of(log, service).size();
    verdict.demand(lives == 1, service + " began " + std::to_string(lives) + " times");
  }
}

void demand_none(const std::string& service, const std::string& counter,
                 const std::optional<std::int64_t>& count, Verdict& verdict) {
  verdict.demand(count == 0, service + ": " + counter + " " +
                                 (count ? std::to_string(*count) : "is not in its last STATUS"));
}

void demand_none(const BusLog& log, const std::string& service, const std::string& counter,
                 Verdict& verdict) {
  for (const ServiceRun& run : runs_of(log, service)) {
    demand_none(service, counter, run.counter(counter), verdict);
  }
}

// Of a counter that a service reports unless it is 0.
void demand_none_rare(const BusLog& log, const std::string& service, const std::string& counter,
                      Verdict& verdict) {
  for (const ServiceRun& run : runs_of(log, service)) {
    demand_none(service, counter, run.rare_counter(counter), verdict);
  }
}

}  // namespace

void judge_game(const GameRecord& game, Verdict& verdict) {
  for (const std::string service : kServices) {
    verdict.demand(!runs_of(game.log, service).empty(), service + " was never heard");
  }
  verdict.demand(was_commanded(game.log), "the arm never followed a command");
  const DemoFigures& figures = game.figures;
  verdict.demand(figures.median_px.has_value(), "no estimate can be compared with the truth");
  if (figures.median_px) {
    verdict.demand(
        *figures.median_px < kMedianPx,
        "half of the estimates are " + figure_text(*figures.median_px, 2, "px off and more"));
    verdict.demand(*figures.lost_percent < kLostPercent,
                   "the puck is lost " + figure_text(*figures.lost_percent, 1, "% of the time"));
  }
  verdict.demand(game.log.largest_datagram_bytes <= kFrameBytes,
                 "a message on " + game.log.largest_datagram_channel + " takes " +
                     std::to_string(game.log.largest_datagram_bytes) +
                     " bytes, more than one frame");
}

void judge_nothing_lost(const GameRecord& game, Verdict& verdict) {
  demand_one_life(game.log, verdict);
  for (const std::string service : kServices) {
    for (const ServiceRun& run : runs_of(game.log, service)) {
      // The logger's last STATUS comes when its log is closed.
      verdict.demand(run.has_said_goodbye() || service == "puck-logger",
                     service + " ended without a last STATUS");
    }
  }
  demand_none(game.log, "puck-tracker", "packets_lost", verdict);
  demand_none(game.log, "puck-logger", "packets_lost", verdict);
  const DemoFigures& figures = game.figures;
  verdict.demand(figures.events_lost == 0,
                 std::to_string(figures.events_sent.value_or(-1)) + " events were sent, " +
                     std::to_string(figures.events_received.value_or(-1)) + " received");
  verdict.note("largest datagram " + std::to_string(game.log.largest_datagram_bytes) + " B");
}

void judge_frame_loss(const GameRecord& game, double percent, Verdict& verdict) {
  demand_one_life(game.log, verdict);
  for (const ServiceRun& run : runs_of(game.log, "puck-tracker")) {
    const auto lost = static_cast<double>(run.counter("packets_lost").value_or(0));
    const double sent = lost + static_cast<double>(run.counter("packets_received").value_or(0));
    const double lost_percent = sent > 0 ? 100 * lost / sent : 0;
    const std::string lost_text = figure_text(lost_percent, 2, "% of the packets lost");
    verdict.note(lost_text);
    verdict.demand(lost_percent > percent / 2 && lost_percent < percent * 2, lost_text);
  }
}

void judge_narrow_link(const GameRecord& game, Verdict& verdict) {
  demand_one_life(game.log, verdict);
  demand_none(game.log, "puck-tracker", "packets_lost", verdict);
  constexpr std::int64_t kWindowUs = 100'000;
  std::map<std::int64_t, std::size_t> bytes_in_window;
  for (const auto& [at_us, bytes] : game.log.events_datagrams) {
    bytes_in_window[at_us / kWindowUs] += bytes + kHeaderBytes;
  }
  std::size_t most = 0;
  for (const auto& [window, bytes] : bytes_in_window) most = std::max(most, bytes);
  verdict.note("EVENTS take up to " +
               figure_text(8.0 * static_cast<double>(most) / kWindowUs, 1, "Mbit/s"));
}

void judge_neighbour(const GameRecord& game, Verdict& verdict) {
  demand_one_life(game.log, verdict);
  verdict.demand(game.log.events_sessions.size() == 1,
                 "events of " + std::to_string(game.log.events_sessions.size()) + " cameras");
  demand_none(game.log, "puck-tracker", "packets_of_others", verdict);
  demand_none(game.log, "puck-tracker", "packets_lost", verdict);
  demand_none_rare(game.log, "puck-arm", "estimates_of_others", verdict);
  demand_none_rare(game.log, "puck-arm", "refused_other_publisher", verdict);
  demand_none_rare(game.log, "puck-arm", "refused_other_arm", verdict);
}

void judge_intruder(const GameRecord& game, const std::vector<MemoryUse>& memory,
                    Verdict& verdict) {
  demand_one_life(game.log, verdict);
  std::string counts;
  for (const std::string service : {"puck-camera", "puck-tracker", "puck-bridge", "puck-arm"}) {
    for (const ServiceRun& run : runs_of(game.log, service)) {
      const std::int64_t rejected = run.counter("messages_rejected").value_or(0);
      verdict.demand(rejected > 0, service + " has counted no malformed message");
      counts += (counts.empty() ? "" : ", ") + std::to_string(rejected);
    }
  }
  verdict.note("rejected: " + counts);
  double most_percent = 0;
  for (const MemoryUse& use : memory) {
    const auto before = static_cast<double>(use.before_kb);
    const double growth_kb = static_cast<double>(use.after_kb) - before;
    const double growth_percent = 100 * growth_kb / before;
    most_percent = std::max(most_percent, growth_percent);
    verdict.demand(growth_kb < kMemoryKb + before * kMemoryPercent / 100,
                   use.service + " grew by " + figure_text(growth_percent, 1, "%"));
  }
  verdict.demand(!memory.empty(), "nobody measured memory");
  verdict.note("memory grew by up to " + figure_text(most_percent, 1, "%"));
}

void judge_replay(const GameRecord& game, Verdict& verdict) {
  const DemoFigures& figures = game.figures;
  verdict.demand(figures.replay_mean_difference_px.has_value(),
                 "no replayed estimate can be compared with a recorded one");
  if (!figures.replay_mean_difference_px) return;
  const std::string difference =
      figure_text(*figures.replay_mean_difference_px, 3, "px from the recorded ones");
  verdict.note(std::to_string(*figures.replay_estimates) + " estimates, " + difference);
  verdict.demand(*figures.replay_mean_difference_px < kReplayPx, difference);
}

}  // namespace puck
