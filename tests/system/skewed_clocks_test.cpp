// The game on machines with clocks hours and days apart.
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/system/running_game.h"

namespace puck {
namespace {

constexpr std::int64_t kHourUs = 3'600'000'000;

/// Offset of `other`'s clock from `who`'s own, as `who` reports it, µs.
std::int64_t offset_said(const RunningGame& game, const std::string& who,
                         const std::string& other) {
  return game.counter(who, "clock_offset_us " + other);
}

}  // namespace

TEST_CASE("with clocks hours and days apart the game is played, and latencies are unchanged") {
  RunningGame game(new_lcm_url());
  game.set_clock("puck-camera", "-2d");
  game.set_clock("puck-tracker", "-3h");
  game.set_clock("puck-bridge", "+5h");
  game.start_all();
  REQUIRE(game.until(
      [&] { return game.plays() && game.counter("puck-arm", "commands_accepted") > 200; }));

  const auto check_offset = [&](const char* who, const char* other, std::int64_t truth_us) {
    CAPTURE(who);
    CAPTURE(other);
    std::int64_t error_us = 0;
    // On a busy machine a quick exchange takes a while.
    CHECK(game.until([&] {
      error_us = std::abs(offset_said(game, who, other) - truth_us);
      return error_us < 20'000;
    }));
    std::printf("%s knows the clock of %s to %lld us\n", who, other,
                static_cast<long long>(error_us));
  };
  check_offset("puck-arm", "puck-bridge", 5 * kHourUs);
  check_offset("puck-arm", "puck-tracker", -3 * kHourUs);
  check_offset("puck-tracker", "puck-camera", -45 * kHourUs);
  check_offset("puck-bridge", "puck-tracker", -8 * kHourUs);
  check_offset("puck-logger", "puck-arm", 0);

  REQUIRE(game.estimate());
  CHECK((game.estimate()->flags & puck_estimate_t::FLAG_LIVE) != 0);
  CHECK(std::abs(game.estimate()->utime - game.estimate()->event_utime) < 10'000'000);
  CHECK(game.arm()->estimate_to_motion_us < 10'000'000);
  // A machine's pause of 200 ms makes a few commands too old.
  const std::int64_t accepted = game.counter("puck-arm", "commands_accepted");
  CHECK(game.counter("puck-arm", "refused_old") < accepted / 4);
  CHECK(game.counter("puck-arm", "refused_from_future") < accepted / 4);

  // An operator's clock may be off as well.
  const std::vector<std::string> operate{program("puck-arm"), "--lcm-url", game.url()};
  const auto run = [&](const char* word) {
    std::vector<std::string> command = operate;
    command.push_back(word);
    return run_program(game.with_clock("+7h", command), {.folder = source_folder()}).exit_code;
  };
  CHECK(run("--stop") == 0);
  CHECK(game.until([&] { return game.arm()->state == arm_state_t::STATE_STOPPED; }));
  CHECK(run("--reset") == 0);
  CHECK(game.until([&] { return game.arm()->state != arm_state_t::STATE_STOPPED; }));
}

}  // namespace puck
