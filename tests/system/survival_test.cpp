// Services that are killed, frozen or duplicated in a game. The goals (1 s until it rejoins the
// game, 500 ms until a silence is reported) are printed beside the measurements; the tests
// themselves wait longer, because a busy machine may take longer.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "tests/system/running_game.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

long long ms_since(Clock::time_point began) {
  return std::chrono::duration_cast<milliseconds>(Clock::now() - began).count();
}

std::map<std::string, std::int64_t> sessions_but_of(const RunningGame& game,
                                                    const std::string& name) {
  std::map<std::string, std::int64_t> sessions;
  for (const std::string& service : kServices) {
    if (service != name) sessions[service] = game.session(service);
  }
  return sessions;
}

void check_all_run(RunningGame& game) {
  for (const std::string& service : kServices) {
    CAPTURE(service);
    CHECK(game.process(service).is_running());
  }
}

// Whether it rests for a second, after the first half second.
bool stands_within(RunningGame& game, milliseconds time) {
  const auto end = Clock::now() + time;
  do {
    game.listen(milliseconds(500));
    game.take_arm_span_m();
    game.listen(milliseconds(1000));
    if (game.take_arm_span_m() < kStillM) return true;
  } while (Clock::now() < end);
  return false;
}

// The services that report its silence.
const std::map<std::string, std::vector<std::string>> kNeededBy{
    {"puck-camera", {"puck-tracker"}},
    {"puck-tracker", {"puck-bridge", "puck-arm"}},
    {"puck-bridge", {"puck-arm"}},
    {"puck-arm", {"puck-bridge", "puck-camera"}}};

bool says(const RunningGame& game, const std::string& who, const std::string& what) {
  return game.state_text(who).find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("each killed and restarted service rejoins the game; the others continue") {
  RunningGame game(new_lcm_url());
  game.start_all();
  REQUIRE(game.until([&] { return game.plays(); }));
  for (const std::string& service : kServices) {
    CAPTURE(service);
    const auto others = sessions_but_of(game, service);
    const std::int64_t killed = game.session(service);
    game.kill(service);
    const auto began = Clock::now();
    game.start(service);
    REQUIRE(game.until([&] { return game.session(service) != killed; }));
    const long long heard_ms = ms_since(began);
    // A logger only writes.
    REQUIRE(game.until([&] {
      return game.plays() &&
             (service != "puck-logger" || game.counter(service, "messages_written") > 100);
    }));
    std::printf(
        "%s killed and started: heard after %lld ms, part of the game after %lld ms "
        "(bar: 1000)\n",
        service.c_str(), heard_ms, ms_since(began));
    game.listen(milliseconds(500));
    CHECK(sessions_but_of(game, service) == others);
    check_all_run(game);
  }
  for (const std::string& service : kServices) {
    CAPTURE(service);
    game.process(service).send(SIGTERM);
    CHECK(game.process(service).wait_for(std::chrono::seconds(10)) == 0);
  }
}

TEST_CASE("a frozen service is named by its dependents, the arm stops, the game continues") {
  RunningGame game(new_lcm_url());
  game.start_all();
  REQUIRE(game.until([&] { return game.plays(); }));
  for (const auto& entry : kNeededBy) {
    const std::string& service = entry.first;
    CAPTURE(service);
    const auto sessions = sessions_but_of(game, "");
    const std::string silent = game.name_and_place(service) + ", is silent";
    game.process(service).send(SIGSTOP);
    const auto began = Clock::now();
    for (const std::string& other : entry.second) {
      CAPTURE(other);
      CHECK(game.until([&] { return says(game, other, silent); }));
      std::printf("%s frozen: %s says so after %lld ms (bar: 500)\n", service.c_str(),
                  other.c_str(), ms_since(began));
    }
    // It may have been moving, and late to report it; then it rests.
    CHECK(stands_within(game, std::chrono::seconds(5)));

    const std::int64_t accepted = game.counter("puck-arm", "commands_accepted");
    game.process(service).send(SIGCONT);
    const auto continued = Clock::now();
    CHECK(game.until([&] {
      return game.plays() && game.counter("puck-arm", "commands_accepted") > accepted + 20;
    }));
    std::printf("%s goes on: the game does after %lld ms\n", service.c_str(), ms_since(continued));
    for (const std::string& other : entry.second) {
      CHECK(game.until([&] { return !says(game, other, "is silent"); }));
    }
    CHECK(sessions_but_of(game, "") == sessions);
    check_all_run(game);
  }
}

TEST_CASE("a second camera is named by host and pid, and the tracker keeps to the first") {
  RunningGame game(new_lcm_url());
  game.start_all();
  REQUIRE(game.until([&] { return game.plays(); }));
  const std::int64_t first = game.session("puck-camera");
  // Slow, so that two simulated tables do not overload the machine: a first camera with 500 ms of
  // silence would be replaced.
  ChildProcess second = start_service("puck-camera", game.url(), {"camera.speed=0.2"});
  const std::string place = ", pid " + std::to_string(second.pid());
  for (const char* other : {"puck-tracker", "puck-bridge", "puck-arm", "puck-logger"}) {
    CAPTURE(other);
    CHECK(game.until([&] {
      return says(game, other, "two services of one kind: puck-camera on ") &&
             says(game, other, place);
    }));
  }
  CHECK(game.until([&] { return game.counter("puck-tracker", "packets_of_others") > 50; }));
  CHECK(game.estimate()->events_session == first);
  second.send(SIGTERM);
  CHECK(second.wait_for(std::chrono::seconds(10)) == 0);
  CHECK(game.until([&] { return !says(game, "puck-tracker", "two services of one kind"); }));
  check_all_run(game);
}

}  // namespace puck
