#include "services/arm/arm_service.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <doctest/doctest.h>

#include "common/messages/host_time.h"
#include "common/messaging/bus_settings.h"
#include "services/arm/operator_command.h"
#include "tests/support/environment.h"
#include "tests/support/service_bench.h"
#include "tests/support/skewed_machine.h"
#include "tests/support/status_counter.h"
#include "tests/support/test_url.h"
#include "tests/support/thread_wake_ups.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

// A running arm, and its newest published state.
class RunningArm {
 public:
  explicit RunningArm(const std::string& url = "memq://") : bench(url) {
    bench.bus.subscribe<arm_state_t>([this](const arm_state_t& state, const Receipt&) {
      const std::lock_guard lock(mutex_);
      state_ = state;
    });
    Config config;
    bench.make<ArmService>(ArmService::read_params(config));
    REQUIRE(bench.start());
  }
  ~RunningArm() { bench.stop(); }

  std::optional<arm_state_t> state() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }
  bool is_in(std::int8_t wanted) const {
    const auto now = state();
    return now && now->state == wanted;
  }

  static puck_estimate_t track() {
    puck_estimate_t estimate{};
    estimate.sensor_us = host_monotonic_us();
    estimate.state = puck_estimate_t::STATE_TRACKING;
    estimate.flags = puck_estimate_t::FLAG_POSITION;
    estimate.flags |= puck_estimate_t::FLAG_LIVE;
    estimate.image_width = 640;
    estimate.image_height = 480;
    return estimate;
  }
  static arm_command_t command_for(std::int64_t arm_session, double target_m) {
    arm_command_t command{};
    command.mode = arm_command_t::MODE_FOLLOW;
    command.target_m = target_m;
    command.valid_for_us = 100'000;
    command.arm_session = arm_session;
    return command;
  }
  void say_track() {
    puck_estimate_t estimate = track();
    bench.bus.publish(estimate);
  }
  void command(double target_m) {
    arm_command_t command = command_for(bench.bus.session(), target_m);
    command.estimate_session = bench.bus.session();
    bench.bus.publish(command);
  }
  bool moves_to(double target_m) { return comes_to(target_m).has_value(); }
  /// The state in which it reaches the target, following our command and track; nothing if it does
  /// not within 10 s.
  std::optional<arm_state_t> comes_to(double target_m) {
    std::optional<arm_state_t> now;
    const bool is_there = ServiceBench::until(
        [&] {
          now = state();
          return now && std::abs(now->position_m - target_m) < 0.005 &&
                 now->command_session == bench.bus.session() &&
                 now->estimate_session == bench.bus.session();
        },
        [&] {
          say_track();
          command(target_m);
        });
    return is_there ? now : std::nullopt;
  }

  /// From the last STATUS.
  std::optional<std::int64_t> counter(const std::string& name) const {
    return test::counter(*bench.service, name);
  }

  ServiceBench bench;

 private:
  mutable std::mutex mutex_;
  std::optional<arm_state_t> state_;
};

int operate(const std::string& word, const std::string& url) {
  OperatorCommand by_hand;
  CLI::App app;
  by_hand.add_options(app);
  app.parse(word);
  return by_hand.run({.url = url}, {}).value_or(-1);
}

TEST_CASE("The arm service moves on commands and estimates from the bus and reports its position") {
  RunningArm arm;
  // With both sessions: after a delay the arm forgets them until new messages come.
  const std::optional<arm_state_t> state = arm.comes_to(0.2);
  REQUIRE(state.has_value());
  CHECK(state->back_end == "simulated");
  CHECK(state->line_max_m == 0.3);
}

TEST_CASE("The arm service sleeps between steps at any rate of estimates") {
  ServiceBench bench;
  WakeUpTally tally;
  Config config;
  // Steps so rare that even a machine that sends slowly makes fewer of them than messages.
  config.override_with("arm.loop_hz=100");
  bench.make<ArmService>(ArmService::read_params(config));
  bench.bus.subscribe<puck_estimate_t>(
      [&](const puck_estimate_t&, const Receipt&) { tally.add(); });
  REQUIRE(bench.start());
  REQUIRE(publish_ten_a_ms(bench.bus, puck_estimate_t{}, 2000));
  // An arm that ends leaves the newest messages unread.
  const auto all_came = [&] {
    return bench.bus.counters<puck_estimate_t>().arrivals.received == 2000;
  };
  CHECK(ServiceBench::until(all_came, [] {}));
  bench.stop();
  CHECK(tally.messages == 2000);
  CHECK(tally.wake_ups() < tally.messages / 2);
}

TEST_CASE("In a flood the arm handles messages between its steps, but sleeps before each step") {
  ServiceBench bench;
  WakeUpTally tally;
  std::atomic<bool> all_sent = false;
  Config config;
  config.override_with("arm.loop_hz=100");
  bench.make<ArmService>(ArmService::read_params(config));
  bench.bus.subscribe<puck_estimate_t>([&](const puck_estimate_t&, const Receipt&) {
    while (!all_sent) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    tally.add();
    const std::int64_t begin_us = host_monotonic_us();
    while (host_monotonic_us() - begin_us < 200) continue;
  });
  REQUIRE(bench.start());
  puck_estimate_t estimate{};
  for (int i = 0; i < 20'000; ++i) bench.bus.publish(estimate);
  all_sent = true;
  wait_until([&] { return tally.messages > 2'000; });
  bench.stop();
  StatusReport report;
  bench.service->report(report);
  REQUIRE(report.latencies[1].name == "loop_jitter");
  const std::int64_t steps_taken = report.latencies[1].samples;
  REQUIRE(tally.messages > 100);
  // 10 ms a step, of which 1 ms would be 5 messages.
  CHECK(tally.messages > 10 * steps_taken);
  CHECK(tally.wake_ups() >= steps_taken / 2);
}

TEST_CASE("The arm service stands still when the bus falls silent") {
  RunningArm arm;
  CHECK(arm.moves_to(0.1));
  const auto stands = [&] {
    const auto now = arm.state();
    return now->state == arm_state_t::STATE_HOLDING && now->reason == "no fresh command";
  };
  CHECK(ServiceBench::until(stands, [] {}));
}

// The last state of an arm that was ended during a fast motion. Nothing if its loop was delayed
// meanwhile: such an arm does not brake, but takes its joints to rest.
std::optional<arm_state_t> last_of_a_fast_arm() {
  RunningArm arm;
  double target_m = 0.3;
  const auto moves_fast = [&] {
    const auto now = arm.state();
    return now && std::abs(now->velocity_m_s) > 0.5 && host_utime() - now->utime < 20'000;
  };
  REQUIRE(ServiceBench::until(moves_fast, [&] {
    // To and fro, in case it passed the target unseen.
    if (arm.state() && std::abs(arm.state()->position_m - target_m) < 0.01) target_m = -target_m;
    arm.say_track();
    arm.command(target_m);
  }));
  arm.bench.stop();
  return arm.counter("pauses") ? std::nullopt : arm.state();
}

TEST_CASE("The arm service brakes before it ends, with or without commands") {
  std::optional<arm_state_t> last;
  for (int attempt = 0; attempt < 30 && !last; ++attempt) last = last_of_a_fast_arm();
  REQUIRE(last.has_value());
  CHECK(last->reason == "shutting down");
  // The joints follow the set-points, which are at rest.
  CHECK(std::abs(last->velocity_m_s) < 0.3);
  CHECK(last->faults == 0);
}

TEST_CASE("The arm follows a bridge and a tracker with clocks hours away, once they answer") {
  constexpr std::int64_t kHourUs = 3'600'000'000;
  const std::string url = private_lcm_url();
  RunningArm arm(url);
  SkewedMachine machine(url, 4711, 5 * kHourUs);
  const auto play = [&](double target_m, std::int64_t age_us) {
    machine.serve();
    machine.publish(RunningArm::track());
    arm_command_t command = RunningArm::command_for(arm.bench.bus.session(), target_m);
    command.estimate_session = machine.session();
    machine.publish(command, age_us);
  };
  const auto refused = [&] { return arm.state() ? arm.state()->commands_refused : 0; };

  machine.answer(false);
  CHECK(ServiceBench::until([&] { return refused() > 50; }, [&] { play(0.2, 0); }));
  CHECK(arm.state()->position_m == 0);
  machine.answer(true);
  CHECK(ServiceBench::until([&] { return std::abs(arm.state()->position_m - 0.2) < 0.005; },
                            [&] { play(0.2, 0); }));
  CHECK(arm.state()->estimate_to_motion_us < 5'000'000);
  // Commands of half a second ago, by the same clock.
  const std::int64_t refused_before = refused();
  CHECK(ServiceBench::until([&] { return refused() > refused_before + 50; },
                            [&] { play(-0.2, 500'000); }));
  CHECK(std::abs(arm.state()->position_m - 0.2) < 0.005);

  arm.bench.stop();
  CHECK(arm.counter("refused_clock_unknown") > 50);
  CHECK(arm.counter("refused_old") > 50);
}

TEST_CASE("A second bridge, a second tracker and commands for another arm are counted by name") {
  const std::string url = private_lcm_url();
  RunningArm arm(url);
  REQUIRE(arm.moves_to(0.2));
  SkewedMachine second(url, 4711, 0);
  const auto play = [&] {
    arm.say_track();
    arm.command(0.2);
    second.serve();
    second.publish(RunningArm::track());
    second.publish(RunningArm::command_for(arm.bench.bus.session(), -0.2));
    second.publish(RunningArm::command_for(arm.bench.bus.session() + 1, -0.2));
  };
  const std::int64_t refused_before = arm.state()->commands_refused;
  // Its first commands are refused because its clock is unknown.
  CHECK(ServiceBench::until([&] { return arm.state()->commands_refused > refused_before + 1000; },
                            play));
  CHECK(std::abs(arm.state()->position_m - 0.2) < 0.005);

  arm.bench.stop();
  CHECK(arm.counter("refused_other_publisher") > 50);
  CHECK(arm.counter("refused_other_arm") > 50);
  CHECK(arm.counter("estimates_of_others") > 50);
}

TEST_CASE("puck-arm --stop latches a running arm and --reset releases it, both confirmed") {
  const std::string url = private_lcm_url();
  RunningArm arm(url);
  CHECK(arm.moves_to(0.1));
  CHECK(operate("--stop", url) == 0);
  const auto is_stopped = [&] { return arm.is_in(arm_state_t::STATE_STOPPED); };
  REQUIRE(ServiceBench::until(is_stopped, [] {}));
  const std::int64_t later = arm.state()->seq + 20;
  bool stays_stopped = true;
  CHECK(ServiceBench::until(
      [&] {
        stays_stopped = stays_stopped && is_stopped();
        return arm.state()->seq >= later;
      },
      [&] {
        arm.say_track();
        arm.command(0.2);
      }));
  CHECK(stays_stopped);
  CHECK(operate("--reset", url) == 0);
  CHECK(arm.moves_to(0.2));
}

TEST_CASE("puck-arm --stop and --reset fail when no arm confirms them") {
  const std::string url = private_lcm_url();
  CHECK(operate("--stop", url) == 1);
  CHECK(operate("--reset", url) == 1);
}

TEST_CASE("puck-arm --stop and --reset are not confirmed by another arm or an arm in a log") {
  const std::string url = private_lcm_url();
  // An arm that another operator stopped and that hears nobody, and one in a log that moves.
  const std::jthread others([&](const std::stop_token& stop) {
    SkewedMachine deaf(url, 4712, 0);
    SkewedMachine log(url, 4713, 0);
    log.answer(false);
    while (!stop.stop_requested()) {
      deaf.serve();
      log.serve();
      arm_state_t state{};
      state.state = arm_state_t::STATE_STOPPED;
      state.reason = "stopped by an operator";
      deaf.publish(state);
      state.state = arm_state_t::STATE_HOLDING;
      log.publish(state, 60'000'000);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  CHECK(operate("--stop", url) == 1);
  CHECK(operate("--reset", url) == 1);
}

TEST_CASE("Impossible arm settings are refused by name") {
  const auto refusal_of = [](const std::string& text) -> std::string {
    try {
      Config config = Config::from_text(text, "arm.toml");
      ArmService::read_params(config);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(refusal_of("[arm]\ndead_man_ms = 150").find("arm.dead_man_ms") != std::string::npos);
  CHECK(refusal_of("[arm]\nmode = \"dance\"").find("arm.mode") != std::string::npos);
  CHECK(refusal_of("[arm]\nmode = \"follow\"").find("arm.table") != std::string::npos);
  CHECK(refusal_of("[arm]\nmax_speed_m_s = -1").find("arm.max_speed_m_s") != std::string::npos);
  CHECK(refusal_of("[arm]\njoint_table = \"/none.toml\"").find("/none.toml") != std::string::npos);
  CHECK(refusal_of("[arm]\nback_end = \"yarp\"").find("arm.joint_table") != std::string::npos);
  CHECK(refusal_of("[arm]\nsimulated_delay_ms = 101").find("arm.simulated_delay_ms") !=
        std::string::npos);
}

TEST_CASE("A real arm needs a key on its bus, unless the settings allow a bus without one") {
  const auto refusal_of = [](const BackEndParams& params, bool authenticated) -> std::string {
    try {
      make_back_end(params, {}, authenticated);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  CHECK(refusal_of({.name = "simulated"}, false).empty());
  CHECK(refusal_of({.name = "yarp"}, false).find("give lcm.key_file") != std::string::npos);
  for (const bool allowed : {false, true}) {
    CHECK(refusal_of({.name = "yarp", .allow_unauthenticated = allowed}, true).find("key_file") ==
          std::string::npos);
  }
  CHECK(refusal_of({.name = "yarp", .allow_unauthenticated = true}, false).find("key_file") ==
        std::string::npos);
  // The service checks with the bus's key, too.
  ServiceBench bench;
  ArmServiceParams params;
  params.back_end.name = "yarp";
  CHECK_THROWS_AS(bench.make<ArmService>(params), std::invalid_argument);
}

TEST_CASE("The loop keeps its period under messages, and reports the delay of its steps") {
  RunningArm arm;
  CHECK(arm.moves_to(0.2));
  arm.bench.stop();
  StatusReport report;
  arm.bench.service->report(report);
  REQUIRE(report.latencies.size() == 2);
  CHECK(report.latencies[1].name == "loop_jitter");
  CHECK(report.latencies[1].samples > 50);
  // At any rate of messages: a step each 2 ms, none to catch up.
  CHECK(arm.counter("commands_accepted") > 50);
}

TEST_CASE("config/arm.toml holds every key with its default") {
  Config from_file = Config::from_file(source_folder() / "config/arm.toml");
  Config defaults;
  ArmService::read_params(from_file);
  ArmService::read_params(defaults);
  CHECK(from_file.effective() == defaults.effective());
  std::istringstream settings(defaults.effective());
  for (std::string line; std::getline(settings, line);) {
    CAPTURE(line);
    CHECK(from_file.has(line.substr(0, line.find(' '))));
  }
  read_bus_params(from_file);
  CHECK_NOTHROW(from_file.reject_unknown());
}

}  // namespace
}  // namespace puck
