// lcm-logplayer plays a game's log, with its commands, to a live arm.
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/log_file.h"
#include "tests/system/running_game.h"

namespace puck {
namespace {

std::int64_t commands_in(const std::filesystem::path& log, std::int64_t arm_session) {
  LogReader reader(log);
  LogRecord record;
  std::int64_t commands = 0;
  while (reader.next(record)) {
    if (record.channel != "PUCK_ARM_COMMAND") continue;
    arm_command_t command;
    REQUIRE_FALSE(decode(record.bytes, command).has_value());
    if (command.arm_session == arm_session) ++commands;
  }
  return commands;
}

// Plays the log to the end. Returns the span of the arm's positions meanwhile, m.
double span_while_played(RunningGame& game, const std::filesystem::path& log) {
  game.take_arm_span_m();
  ChildProcess player({"lcm-logplayer", "--lcm-url=" + game.url(), log.string()},
                      {.output = "/dev/null", .errors = "/dev/null"});
  CHECK(game.until([&] { return !player.is_running(); }));
  game.listen(std::chrono::milliseconds(300));
  return game.take_arm_span_m();
}

}  // namespace

TEST_CASE("a log full of commands moves no arm, neither its own nor another") {
  RunningGame game(new_lcm_url());
  game.start_all();
  REQUIRE(game.until([&] { return game.plays(); }));
  double span_m = 0;
  for (int i = 0; i < 8 && span_m <= 0.01; ++i) {
    game.take_arm_span_m();
    game.listen(std::chrono::seconds(5));
    span_m = game.take_arm_span_m();
  }
  CHECK(span_m > 0.01);
  REQUIRE(game.until([&] { return game.counter("puck-arm", "commands_accepted") > 300; }));
  const std::int64_t arm_session = game.session("puck-arm");
  for (const char* name : {"puck-camera", "puck-bridge", "puck-tracker", "puck-logger"}) {
    game.process(name).send(SIGTERM);
    REQUIRE(game.process(name).wait_for(std::chrono::seconds(10)) == 0);
  }
  const std::filesystem::path log = game.log_path();
  const std::int64_t commands = commands_in(log, arm_session);
  REQUIRE(commands > 200);

  // The arm of the log still runs, so the commands answer its session; a new tracker and a new
  // bridge process the log's events.
  game.start("puck-tracker");
  game.start("puck-bridge");
  REQUIRE(game.until([&] {
    return game.counter("puck-arm", "commands_refused") >= 0 &&
           game.state_text("puck-tracker").find("for events") != std::string::npos;
  }));
  game.listen(std::chrono::seconds(1));
  CHECK(span_while_played(game, log) < kStillM);
  const std::int64_t refused = game.counter("puck-arm", "commands_refused");
  CHECK(refused >= commands / 2);
  CHECK(game.counter("puck-tracker", "packets_not_live") > 100);
  CHECK(game.process("puck-arm").is_running());
  std::printf("%lld commands played to the arm of the log: %lld refused so far, it stood still\n",
              static_cast<long long>(commands), static_cast<long long>(refused));

  // Another arm; and one that follows the tracker by itself, without commands.
  const std::vector<std::vector<std::string>> kinds{
      {}, {"arm.mode=follow", "arm.table=config/calibration/simulated_table.toml"}};
  for (const std::vector<std::string>& settings : kinds) {
    const std::int64_t before = game.session("puck-arm");
    game.kill("puck-arm");
    game.start("puck-arm", settings);
    REQUIRE(game.until([&] {
      return game.session("puck-arm") != before && game.arm()->session == game.session("puck-arm");
    }));
    game.listen(std::chrono::seconds(1));
    game.take_tracked();
    CHECK(span_while_played(game, log) < kStillM);
    // There was something to follow.
    CHECK(game.take_tracked() > 100);
    CHECK(game.counter("puck-arm", "estimates_used") > 100);
    CHECK(game.process("puck-arm").is_running());
  }
}

}  // namespace puck
