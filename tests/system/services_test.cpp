// Start and stop of every service.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/messages/host_time.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/message_codec.h"
#include "tests/support/stuck_pipe.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/running_game.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::string> settings_for(const std::string& service, const TemporaryFolder& folder) {
  if (service == "puck-logger") return {"logger.path=" + (folder / "a.lcm").string()};
  // A simulation too fast for a busy machine would be degraded, and report it.
  if (service == "puck-camera") return {"camera.speed=0.05"};
  return {};
}

}  // namespace

TEST_CASE("the STATUS of each service fits one frame in a game") {
  const TemporaryFolder folder;
  const std::string url = new_lcm_url();
  BusListener bus(url);
  std::vector<std::unique_ptr<ChildProcess>> services;
  for (const std::string& service : kServices) {
    std::vector<std::string> settings;
    if (service == "puck-logger") settings = settings_for(service, folder);
    services.push_back(
        std::unique_ptr<ChildProcess>(new ChildProcess(start_service(service, url, settings))));
  }
  REQUIRE(bus.hears(kServices));
  REQUIRE(bus.until([&] { return bus.counter("puck-arm", "commands_accepted") > 50; }));
  std::vector<std::uint8_t> bytes;
  for (const std::string& service : kServices) {
    service_status_t status = *bus.status(service);
    encode(status, bytes);
    const std::size_t header = 8 + std::string("ABCDEFGHIJKLMNOP_PUCK_STATUS").size() + 1;
    std::printf("STATUS of %s: %zu bytes\n", service.c_str(), header + bytes.size());
    CHECK_MESSAGE(header + bytes.size() <= EventPackerParams::kOneFrame, service);
  }
}

TEST_CASE("--check exits with 1 for a service that is not running") {
  const std::string url = new_lcm_url();
  std::vector<std::unique_ptr<ChildProcess>> checks;
  for (const std::string& service : kServices) {
    checks.push_back(std::make_unique<ChildProcess>(
        std::vector<std::string>{program(service), "--lcm-url", url, "--check"},
        ChildOptions{.folder = source_folder(), .output = "/dev/null"}));
  }
  for (auto& check : checks) CHECK(check->wait_for(std::chrono::seconds(20)) == 1);
}

TEST_CASE(
    "--check exits with 0 for a running service; SIGTERM and SIGINT end it with a last STATUS") {
  for (const int signal : {SIGTERM, SIGINT}) {
    for (const std::string& service : kServices) {
      CAPTURE(service);
      CAPTURE(signal);
      const TemporaryFolder folder;
      const std::string url = new_lcm_url();
      BusListener bus(url);
      ChildProcess child = start_service(service, url, settings_for(service, folder));
      REQUIRE(bus.hears({service}));
      CHECK(check_service_program(service, url) == 0);
      // A service without a signal.
      CHECK(child.is_running());

      const auto began = Clock::now();
      child.send(signal);
      CHECK(child.wait_for(std::chrono::seconds(10)) == 0);
      const auto took_ms =
          std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - began).count();
      std::printf("%s stopped %lld ms after signal %d\n", service.c_str(),
                  static_cast<long long>(took_ms), signal);
      CHECK(took_ms < 2000);
      CHECK(
          bus.until([&] { return bus.status(service)->state == service_status_t::STATE_STOPPING; },
                    std::chrono::seconds(2)));
    }
  }
}

TEST_CASE("A service with an unread log works, and SIGTERM ends it") {
  for (const std::string& service : kServices) {
    CAPTURE(service);
    const TemporaryFolder folder;
    const StuckPipe nobody;
    const std::string url = new_lcm_url();
    BusListener bus(url);
    ChildProcess child(service_command(service, url, settings_for(service, folder)),
                       {.folder = source_folder(), .errors = nobody.path()});
    REQUIRE(bus.hears({service}));
    child.send(SIGTERM);
    const auto began = Clock::now();
    CHECK(child.wait_for(std::chrono::seconds(10)) == 0);
    const auto took_ms =
        std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - began).count();
    std::printf("%s, whose log nobody reads, stopped after %lld ms\n", service.c_str(),
                static_cast<long long>(took_ms));
    CHECK(bus.until([&] { return bus.status(service)->state == service_status_t::STATE_STOPPING; },
                    std::chrono::seconds(2)));
  }
}

TEST_CASE("An arm with an unread log plays, and comes to rest when SIGTERM ends it") {
  const StuckPipe nobody;
  RunningGame game(new_lcm_url());
  for (const char* name : {"puck-tracker", "puck-bridge", "puck-camera"}) game.start(name);
  // After a delay of more than 20 ms an arm does not brake, but takes its joints to rest.
  bool was_held_up = true;
  for (int attempt = 0; attempt < 10 && was_held_up; ++attempt) {
    ChildProcess arm(service_command("puck-arm", game.url()),
                     {.folder = source_folder(), .errors = nobody.path()});
    const std::int64_t session_before = game.session("puck-arm");
    REQUIRE(game.until([&] { return game.session("puck-arm") != session_before && game.plays(); }));
    REQUIRE(game.until([&] {
      return std::abs(game.arm()->velocity_m_s) > 0.3 && host_utime() - game.arm()->utime < 20'000;
    }));
    const std::int64_t pauses = game.counter("puck-arm", "pauses");
    arm.send(SIGTERM);
    CHECK(arm.wait_for(std::chrono::seconds(10)) == 0);
    REQUIRE(game.until([&] { return game.is_stopping("puck-arm"); }));
    was_held_up = game.counter("puck-arm", "pauses") != pauses;
    if (was_held_up) continue;
    CHECK(game.arm()->reason == "shutting down");
    // The joints follow the set-points, which are at rest.
    CHECK(std::abs(game.arm()->velocity_m_s) < 0.3);
  }
  CHECK_FALSE(was_held_up);
}

TEST_CASE("A failed start ends, even if its output is not read") {
  const StuckPipe nobody;
  ChildProcess child({program("puck-arm"), "--set", "arm.mode=dance"},
                     {.folder = source_folder(), .errors = nobody.path()});
  CHECK(child.wait_for(std::chrono::seconds(10)) == 1);
}

}  // namespace puck
