#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"
#include "common/messaging/status_reporter.h"
#include "tests/containers/scenarios.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

constexpr std::int64_t kMs = 1000;
constexpr std::int64_t kStart = 1'000'000'000;

constexpr std::int64_t kTracker = 11;
constexpr std::int64_t kBridge = 12;
constexpr std::int64_t kArm = 13;
constexpr std::int64_t kCamera = 14;
constexpr std::int64_t kLogger = 15;
constexpr std::int64_t kSecondTracker = 21;

/// A scripted game of 4 s: times in ms since its start.
class GameScript {
 public:
  GameScript() {
    status("puck-camera", kCamera, 0);
    status("puck-tracker", kTracker, 0);
    status("puck-bridge", kBridge, 0);
    status("puck-arm", kArm, 0);
    status("puck-logger", kLogger, 0);
  }

  /// The arm's STATUS, with a missing peer.
  void miss(const std::string& service, std::int64_t at_ms) {
    status("puck-arm", kArm, at_ms).state_text = service + " on x, pid 1, is silent";
  }

  service_status_t& status(const std::string& service, std::int64_t session, std::int64_t at_ms) {
    service_status_t status{};
    status.service = service;
    status.session = session;
    status.utime = at(at_ms);
    status.state = service_status_t::STATE_RUNNING;
    hear(session, at_ms);
    return record.log.statuses.emplace_back(Heard<service_status_t>{at(at_ms), status}).message;
  }
  void estimate(std::int64_t session, std::int64_t at_ms) {
    puck_estimate_t estimate{};
    estimate.session = session;
    estimate.state = puck_estimate_t::STATE_TRACKING;
    estimate.events_applied = 1;
    estimate.sensor_us = at_ms * kMs;
    hear(session, at_ms);
    record.log.estimates.push_back({at(at_ms), estimate});
  }
  /// An arm that follows the bridge and a tracker; tracker 0: holds without one.
  void arm(std::int64_t at_ms, std::int64_t tracker) {
    arm_state_t state{};
    state.session = kArm;
    state.state = tracker != 0 ? arm_state_t::STATE_MOVING : arm_state_t::STATE_HOLDING;
    state.reason = tracker != 0 ? "" : "no live track";
    state.command_session = tracker != 0 ? kBridge : 0;
    state.estimate_session = tracker;
    hear(kArm, at_ms);
    record.log.arm_states.push_back({at(at_ms), state});
  }
  /// Tracker and arm in a normal game, every 10 ms.
  void play(std::int64_t from_ms, std::int64_t to_ms, std::int64_t tracker) {
    for (std::int64_t ms = from_ms; ms < to_ms; ms += 10) {
      estimate(tracker, ms);
      arm(ms, tracker);
      hear(kBridge, ms);
    }
  }
  /// The arm alone, without data.
  void hold(std::int64_t from_ms, std::int64_t to_ms) {
    for (std::int64_t ms = from_ms; ms < to_ms; ms += 10) arm(ms, 0);
  }

  GameRecord record;

 private:
  static std::int64_t at(std::int64_t ms) { return kStart + ms * kMs; }
  void hear(std::int64_t session, std::int64_t at_ms) {
    record.log.heard_us[session].push_back(at(at_ms));
  }
};

template <typename Judge>
Verdict judged(const GameScript& game, const Judge& judge) {
  Verdict verdict;
  judge(game.record, verdict);
  return verdict;
}

GameScript killed_and_back(std::int64_t back_ms) {
  GameScript game;
  game.play(0, 1000, kTracker);
  game.hold(1100, back_ms);
  game.miss("puck-tracker", 1400);
  game.status("puck-tracker", kSecondTracker, 2000);
  game.play(back_ms, back_ms + 1000, kSecondTracker);
  return game;
}

GameScript frozen_bridge() {
  GameScript game;
  game.play(0, 1000, kTracker);
  game.hold(1100, 3000);
  game.miss("puck-bridge", 1400);
  game.play(3000, 4000, kTracker);
  return game;
}

GameScript cut_off_tracker() {
  GameScript game;
  game.play(0, 1000, kTracker);
  game.hold(1100, 3500);
  game.miss("puck-tracker", 1400);
  // Its STATUS is sent as soon as the network is back; its estimates take longer.
  game.status("puck-tracker", kTracker, 3300);
  return game;
}

}  // namespace

TEST_CASE("a tracker that restarts within the limit passes") {
  const Verdict verdict = judged(killed_and_back(2300), judge_killed_tracker);
  CHECK(verdict.complaints() == std::vector<std::string>{});
  CHECK(verdict.notes() == std::vector<std::string>{"noticed after 410 ms", "back after 300 ms",
                                                    "arm still after 110 ms"});
}

TEST_CASE("a tracker that restarts too late fails") {
  CHECK_FALSE(judged(killed_and_back(6100), judge_killed_tracker).passed());
}

TEST_CASE("a tracker that never tracks again fails, and so does one that was never killed") {
  GameScript never;
  never.play(0, 1000, kTracker);
  never.status("puck-tracker", kSecondTracker, 2000);
  CHECK_FALSE(judged(never, judge_killed_tracker).passed());

  GameScript alive;
  alive.play(0, 4000, kTracker);
  CHECK_FALSE(judged(alive, judge_killed_tracker).passed());

  GameScript stopped;
  stopped.play(0, 1000, kTracker);
  stopped.status("puck-tracker", kTracker, 1000).state = service_status_t::STATE_STOPPING;
  stopped.hold(1100, 2300);
  stopped.status("puck-tracker", kSecondTracker, 2000);
  stopped.play(2300, 4000, kSecondTracker);
  CHECK_FALSE(judged(stopped, judge_killed_tracker).passed());
}

TEST_CASE("an additional restart of another service fails") {
  GameScript game = killed_and_back(2300);
  game.status("puck-bridge", 99, 2100);
  CHECK_FALSE(judged(game, judge_killed_tracker).passed());
}

TEST_CASE("an arm at rest while the bridge is frozen passes") {
  CHECK(judged(frozen_bridge(), judge_frozen_bridge).complaints() == std::vector<std::string>{});
}

TEST_CASE("an arm in motion while the bridge is frozen fails") {
  GameScript game = frozen_bridge();
  game.arm(2000, kTracker);
  CHECK_FALSE(judged(game, judge_frozen_bridge).passed());
}

TEST_CASE("an arm that never moves after the bridge was frozen fails") {
  GameScript game = frozen_bridge();
  std::erase_if(game.record.log.arm_states,
                [](const auto& heard) { return heard.at_us >= kStart + 3000 * kMs; });
  CHECK_FALSE(judged(game, judge_frozen_bridge).passed());
}

TEST_CASE("an unnoticed frozen bridge fails, and so does one noticed after its return") {
  GameScript game = frozen_bridge();
  game.record.log.statuses.pop_back();
  CHECK_FALSE(judged(game, judge_frozen_bridge).passed());
  game.miss("puck-bridge", 3100);
  CHECK_FALSE(judged(game, judge_frozen_bridge).passed());
}

TEST_CASE("a bridge that was never frozen fails") {
  GameScript game;
  game.play(0, 4000, kTracker);
  CHECK_FALSE(judged(game, judge_frozen_bridge).passed());
}

TEST_CASE("a tracker that receives again after its network has returned passes") {
  GameScript game = cut_off_tracker();
  game.play(3500, 4000, kTracker);
  const Verdict verdict = judged(game, judge_cut_off_tracker);
  CHECK(verdict.complaints() == std::vector<std::string>{});
  CHECK(verdict.notes().back() == "hears again after 200 ms");
}

TEST_CASE(
    "a tracker that receives nothing after its network has returned fails, even if it publishes") {
  GameScript game = cut_off_tracker();
  // Estimates on the last events from before the cut.
  for (std::int64_t ms = 3310; ms < 4000; ms += 20) {
    game.estimate(kTracker, ms);
    game.record.log.estimates.back().message.sensor_us = 990 * kMs;
  }
  CHECK_FALSE(judged(game, judge_cut_off_tracker).passed());
}

TEST_CASE("frame loss passes if the tracker counts about the number of dropped frames") {
  const auto judge = [](std::int64_t lost) {
    GameScript game;
    service_status_t& status = game.status("puck-tracker", kTracker, 4000);
    status.counter_name = {"packets_lost", "packets_received"};
    status.counter_value = {lost, 10'000 - lost};
    Verdict verdict;
    judge_frame_loss(game.record, 5, verdict);
    return verdict.passed();
  };
  CHECK(judge(500));
  CHECK_FALSE(judge(0));
  CHECK_FALSE(judge(2000));
}

TEST_CASE("no loss requires as many events received as sent") {
  const auto judge = [](std::int64_t received, const char* counter = "packets_lost") {
    GameScript game;
    for (const char* service :
         {"puck-camera", "puck-tracker", "puck-bridge", "puck-arm", "puck-logger"}) {
      const std::int64_t session = runs_of(game.record.log, service).front().session;
      service_status_t& status = game.status(service, session, 4000);
      status.state = service_status_t::STATE_STOPPING;
      status.counter_name = {counter};
      status.counter_value = {0};
    }
    game.record.figures.events_sent = 1000;
    game.record.figures.events_received = received;
    game.record.figures.events_lost = 1000 - received;
    return judged(game, judge_nothing_lost).passed();
  };
  CHECK(judge(1000));
  CHECK_FALSE(judge(999));
  // A missing counter is not accepted as 0.
  CHECK_FALSE(judge(1000, "packets_lost_by_another_name"));
}

TEST_CASE("a neighbour's packets cause a failure") {
  const auto judge = [](std::int64_t packets_of_others) {
    GameScript game;
    game.record.log.events_sessions = {kCamera};
    service_status_t& status = game.status("puck-tracker", kTracker, 4000);
    status.counter_name = {"packets_of_others", "packets_lost"};
    status.counter_value = {packets_of_others, 0};
    return judged(game, judge_neighbour).passed();
  };
  CHECK(judge(0));
  CHECK_FALSE(judge(1));
}

TEST_CASE("a counter that is left out of a complete report is 0, of a cut report unknown") {
  ServiceRun run;
  CHECK(run.rare_counter("refused_other_arm") == 0);
  CHECK_FALSE(run.counter("refused_other_arm").has_value());
  run.last.counter_name = {"refused_other_arm", StatusReporter::kLeftOut};
  run.last.counter_value = {3, 1};
  CHECK(run.rare_counter("refused_other_arm") == 3);
  CHECK_FALSE(run.rare_counter("estimates_of_others").has_value());
}

TEST_CASE("an intruder passes if all services count its messages and none grows") {
  const auto judge = [](std::int64_t rejected, std::int64_t after_kb) {
    GameScript game;
    for (const char* service : {"puck-camera", "puck-tracker", "puck-bridge", "puck-arm"}) {
      const std::int64_t session = runs_of(game.record.log, service).front().session;
      service_status_t& status = game.status(service, session, 4000);
      status.counter_name = {"messages_rejected"};
      status.counter_value = {rejected};
    }
    Verdict verdict;
    judge_intruder(game.record, {{"puck-arm", 10'000, after_kb}}, verdict);
    return verdict.passed();
  };
  CHECK(judge(7, 10'500));
  CHECK_FALSE(judge(0, 10'500));
  CHECK_FALSE(judge(7, 12'500));
}

TEST_CASE("a log lists publishers and times, under its prefix only") {
  const TemporaryFolder folder;
  {
    LogWriter writer(folder / "a.lcm");
    std::vector<std::uint8_t> bytes;
    service_status_t status{};
    status.service = "puck-tracker";
    status.host = "a";
    status.version = "1";
    for (const std::int64_t at_ms : {100, 200, 700}) {
      status.session = kTracker;
      status.utime = kStart + at_ms * kMs;
      status.uptime_us = at_ms * kMs;
      encode(status, bytes);
      writer.write("LEFT_PUCK_STATUS", status.utime + 5, bytes);
    }
    status.session = kSecondTracker;
    encode(status, bytes);
    writer.write("PUCK_STATUS", kStart, bytes);
    bytes.pop_back();
    writer.write("LEFT_PUCK_STATUS", kStart, bytes);
  }
  const BusLog log = read_bus_log(folder / "a.lcm", "LEFT");
  const std::vector<ServiceRun> runs = runs_of(log, "puck-tracker");
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].session == kTracker);
  CHECK(runs[0].started_us == kStart);
  CHECK(log.statuses.size() == 3);
  const auto silence = longest_silence(log, kTracker);
  REQUIRE(silence.has_value());
  CHECK(silence->begin_us == kStart + 200 * kMs + 5);
  CHECK(silence->end_us == kStart + 700 * kMs + 5);
  CHECK_FALSE(longest_silence(log, kSecondTracker).has_value());
}

}  // namespace puck
