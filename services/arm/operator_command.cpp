#include "services/arm/operator_command.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/messages/host_time.h"
#include "common/messaging/conversions.h"
#include "services/arm/addressed_arms.h"
#include "services/launch/operator_request.h"

namespace puck {
namespace {

constexpr std::int64_t kAtLeastUs = 200'000;

/// A stop for all arms, or a reset that names each arm heard.
class ArmRequest final : public OperatorRequest {
 public:
  explicit ArmRequest(CommandMode mode) : mode_(mode) {}

  void listen(Bus& bus, StatusReporter& status) override {
    arms_.emplace(mode_, bus.session());
    bus.subscribe<ArmState>([this, &status](const ArmState& state, const Receipt& at) {
      arms_->hear(state, {at.utime, at.monotonic_us}, status.clock_of(state.session));
    });
  }

  bool publish(Bus& bus) override {
    if (is_stop()) {
      publish(bus, 0);
      return true;
    }
    const std::vector<std::int64_t> sessions = arms_->sessions(host_now());
    for (const std::int64_t session : sessions) publish(bus, session);
    return !sessions.empty();
  }

  std::string why_not() const override { return arms_->why_not(host_now()); }
  std::string goal() const override { return is_stop() ? "stopped" : "reset"; }

 private:
  bool is_stop() const { return mode_ == CommandMode::kStop; }

  void publish(Bus& bus, std::int64_t arm_session) const {
    ArmCommand command;
    command.mode = mode_;
    command.from_operator = true;
    command.valid_for_us = kAtLeastUs / 2;
    command.arm_session = arm_session;
    bus.publish(command);
  }

  CommandMode mode_;
  std::optional<AddressedArms> arms_;  // Set by listen().
};

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
  ArmRequest request(stop_ ? CommandMode::kStop : CommandMode::kReset);
  return make_operator_request({"puck-arm", kAtLeastUs}, params, request, std::move(stop));
}

}  // namespace puck
