#include "services/bridge/bridge_service.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <thread>

#include <doctest/doctest.h>
#include <unistd.h>

#include "common/messages/host_time.h"
#include "common/messaging/bus_settings.h"
#include "tests/support/environment.h"
#include "tests/support/service_bench.h"
#include "tests/support/test_camera.h"
#include "tests/support/thread_wake_ups.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

TEST_CASE(
    "The bridge service turns estimates and an arm on the bus into commands and trajectories") {
  ServiceBench bench;
  std::mutex mutex;
  std::optional<arm_command_t> command;
  std::optional<puck_trajectory_t> trajectory;
  bench.bus.subscribe<arm_command_t>([&](const arm_command_t& message, const Receipt&) {
    const std::lock_guard lock(mutex);
    command = message;
  });
  bench.bus.subscribe<puck_trajectory_t>([&](const puck_trajectory_t& message, const Receipt&) {
    const std::lock_guard lock(mutex);
    trajectory = message;
  });
  bench.make<BridgeService>(BridgeServiceParams{{test_camera(), {}}, {}});
  REQUIRE(bench.start());

  const std::int64_t begin_us = host_monotonic_us();
  const auto say = [&] {
    arm_state_t arm{};
    arm.line_min_m = -0.3;
    arm.line_max_m = 0.3;
    bench.bus.publish(arm);
    // A puck that rests at (0.8, 0.2), in the robot's half.
    const Pixel pixel = *test_camera().to_image({0.8, 0.2});
    puck_estimate_t estimate{};
    estimate.sensor_us = host_monotonic_us() - begin_us;
    estimate.state = puck_estimate_t::STATE_TRACKING;
    estimate.flags = puck_estimate_t::FLAG_POSITION;
    estimate.x_px = pixel.x;
    estimate.y_px = pixel.y;
    estimate.image_width = 640;
    estimate.image_height = 480;
    bench.bus.publish(estimate);
  };
  CHECK(ServiceBench::until(
      [&] {
        const std::lock_guard lock(mutex);
        return command && std::abs(command->target_m - 0.1) < 0.01 &&
               command->arm_session == bench.bus.session();
      },
      say));
  bench.stop();
  REQUIRE(trajectory);
  CHECK(trajectory->x_m == doctest::Approx(0.8).epsilon(0.01));
  CHECK(bench.status.state() == ServiceState::kRunning);
}

TEST_CASE("In a flood the bridge pauses every few milliseconds for other threads") {
  ServiceBench bench;
  WakeUpTally tally;
  std::atomic<bool> all_sent = false;
  bench.make<BridgeService>(BridgeServiceParams{{test_camera(), {}}, {}});
  bench.bus.subscribe<game_state_t>([&](const game_state_t&, const Receipt&) {
    while (!all_sent) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    tally.add();
    const std::int64_t begin_us = host_monotonic_us();
    while (host_monotonic_us() - begin_us < 100) continue;
  });
  REQUIRE(bench.start());
  game_state_t game{};
  for (int i = 0; i < 20'000; ++i) bench.bus.publish(game);
  all_sent = true;
  wait_until([&] { return tally.messages > 2'000; });
  bench.stop();
  REQUIRE(tally.messages > 500);
  // 50 messages take 5 ms.
  CHECK(tally.wake_ups() > tally.messages / 100);
}

TEST_CASE("Impossible bridge settings are refused by name, a missing table by its path") {
  const auto table =
      std::filesystem::temp_directory_path() / ("puck_bridge_" + std::to_string(getpid()));
  write_table_file(table, {test_camera(), {}}, "test");
  const auto refusal_of = [&](const std::string& setting) -> std::string {
    try {
      Config config;
      config.override_with("bridge.table=" + table.string());
      config.override_with(setting);
      BridgeService::read_params(config);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(refusal_of("bridge.command_hz=250").empty());
  CHECK(refusal_of("bridge.table=nowhere.toml").find("nowhere.toml") != std::string::npos);
  CHECK(refusal_of("bridge.max_age_ms=500").find("bridge.max_age_ms") != std::string::npos);
  CHECK(refusal_of("motion.rail_grip=2").find("motion.rail_grip") != std::string::npos);
  std::filesystem::remove(table);
}

// The file with the keys set that it leaves to the table.
std::string bridge_toml_in_full() {
  std::ostringstream text;
  text << std::ifstream(source_folder() / "config/bridge.toml").rdbuf();
  const std::regex left_to_the_table("(^|\n)# (\\w+ = [0-9.]+)(?=\n)");
  return std::regex_replace(text.str(), left_to_the_table, "$1$2");
}

TEST_CASE(
    "The puck's motion is taken from the bridge's file, else the table's, else the defaults") {
  const std::filesystem::path table =
      std::filesystem::temp_directory_path() / ("puck_moves_" + std::to_string(getpid()));
  const auto motion_with = [&](const std::string& assignment) {
    Config config = Config::from_file(source_folder() / "config/bridge.toml");
    config.override_with("bridge.table=" + table.string());
    if (!assignment.empty()) config.override_with(assignment);
    return BridgeService::read_params(config).play.motion;
  };
  write_table_file(table, {test_camera(), {}}, "test");
  CHECK(motion_with("").damping_per_s == PuckMotionParams{}.damping_per_s);
  CHECK(motion_with("").rail_grip == PuckMotionParams{}.rail_grip);
  CHECK(motion_with("").bounce_spread == PuckMotionParams{}.bounce_spread);
  write_table_file(table, {test_camera(), {}, std::nullopt, MotionConstants{0.1, 0.9, 0.95}},
                   "test");
  CHECK(motion_with("").damping_per_s == 0.1);
  CHECK(motion_with("").rail_restitution == 0.9);
  CHECK(motion_with("").rail_grip == 0.95);
  CHECK(motion_with("").bounce_spread == kFittedBounceSpread);
  CHECK(motion_with("motion.bounce_spread=0.2").bounce_spread == 0.2);
  CHECK(motion_with("motion.rail_grip=0.7").rail_grip == 0.7);
  CHECK(motion_with("motion.rail_grip=0.7").rail_restitution == 0.9);
  std::filesystem::remove(table);
}

TEST_CASE("config/bridge.toml holds every key with its default") {
  const std::filesystem::path table =
      std::filesystem::temp_directory_path() / ("puck_bridge_" + std::to_string(getpid()));
  write_table_file(table, {test_camera(), {}}, "test");
  Config from_file = Config::from_text(bridge_toml_in_full(), "bridge.toml");
  Config defaults;
  from_file.override_with("bridge.table=" + table.string());
  defaults.override_with("bridge.table=" + table.string());
  BridgeService::read_params(from_file);
  BridgeService::read_params(defaults);
  CHECK(from_file.effective() == defaults.effective());
  std::istringstream settings(defaults.effective());
  for (std::string line; std::getline(settings, line);) {
    CAPTURE(line);
    CHECK(from_file.has(line.substr(0, line.find(' '))));
  }
  read_bus_params(from_file);
  CHECK_NOTHROW(from_file.reject_unknown());
  std::filesystem::remove(table);
}

}  // namespace
}  // namespace puck
