#include "services/arm/operator_command.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/messages/host_time.h"
#include "common/messaging/conversions.h"
#include "common/messaging/status_reporter.h"
#include "services/arm/addressed_arms.h"

namespace puck {
namespace {

constexpr std::int64_t kGiveUpUs = 1'000'000;
constexpr std::int64_t kAtLeastUs = 200'000;
constexpr std::int64_t kPeriodUs = 20'000;
constexpr std::chrono::milliseconds kHandle{5};

void publish(Bus& bus, CommandMode mode, std::int64_t arm_session) {
  ArmCommand command;
  command.mode = mode;
  command.from_operator = true;
  command.valid_for_us = kAtLeastUs / 2;
  command.arm_session = arm_session;
  bus.publish(command);
}

// Returns whether any arm is addressed. A stop is for all arms; a reset names each arm heard.
bool publish_to_all(Bus& bus, CommandMode mode, const AddressedArms& arms) {
  if (mode == CommandMode::kStop) {
    publish(bus, mode, 0);
    return true;
  }
  const std::vector<std::int64_t> sessions = arms.sessions(host_now());
  for (const std::int64_t session : sessions) publish(bus, mode, session);
  return !sessions.empty();
}

}  // namespace

void OperatorCommand::add_options(CLI::App& app) {
  CLI::Option* stop =
      app.add_flag("--stop", stop_,
                   "Stop every arm on the bus until --reset; exit code 0: all arms confirmed it");
  CLI::Option* reset = app.add_flag(
      "--reset", reset_, "Release every stopped or faulty arm; exit code 0: all arms confirmed it");
  stop->excludes(reset);
}

std::optional<int> OperatorCommand::run(const BusParams& params, std::stop_token stop) const {
  if (!stop_ && !reset_) return std::nullopt;
  const CommandMode mode = stop_ ? CommandMode::kStop : CommandMode::kReset;
  const char* word = stop_ ? "stopped" : "reset";

  Bus bus(params);
  // An arm must know our clock before it accepts a reset as current.
  StatusReporter status(bus, "puck-operator");
  AddressedArms arms(mode, bus.session());
  bus.subscribe<ArmState>([&](const ArmState& state, const Receipt& at) {
    arms.hear(state, {at.utime, at.monotonic_us}, status.clock_of(state.session));
  });
  std::stop_source give_up;
  const std::stop_callback on_stop(stop, [&] { give_up.request_stop(); });
  const bool started = bus.start(give_up.get_token(), [&](const std::string& reason) {
    std::fprintf(stderr, "puck-arm: %s\n", reason.c_str());
    give_up.request_stop();
  });
  if (!started) return 1;

  const std::int64_t begin_us = host_monotonic_us();
  std::optional<std::int64_t> first_sent_us;
  std::int64_t next_us = begin_us;
  while (!stop.stop_requested()) {
    bus.handle(kHandle);
    status.poll([](StatusReport&) {});
    const std::int64_t now_us = host_monotonic_us();
    if (now_us >= next_us) {
      next_us = now_us + kPeriodUs;
      if (publish_to_all(bus, mode, arms) && !first_sent_us) first_sent_us = now_us;
    }
    const bool sent_enough = first_sent_us && now_us - *first_sent_us >= kAtLeastUs;
    if (sent_enough && arms.confirm(host_now())) {
      std::printf("puck-arm: %s\n", word);
      return 0;
    }
    if (now_us - begin_us > kGiveUpUs) break;
  }
  std::fprintf(stderr, "puck-arm: not confirmed to be %s within 1 s: %s\n", word,
               arms.why_not(host_now()).c_str());
  return 1;
}

}  // namespace puck
