#include "services/arm/arm_service.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <string_view>

#include "common/io/table_file.h"

namespace puck {
namespace {

constexpr std::int64_t kStepUs = 1000;
constexpr double kStepS = 0.001;
// After a longer pause of this process the missing steps are left out instead of caught up.
constexpr std::int64_t kLongestPauseUs = 100'000;
constexpr std::chrono::milliseconds kHandle{1};

const char* name_of(int state) {
  switch (state) {
    case arm_state_t::STATE_IDLE:
      return "idle";
    case arm_state_t::STATE_MOVING:
      return "moving";
    case arm_state_t::STATE_HOLDING:
      return "holding";
    case arm_state_t::STATE_STOPPED:
      return "stopped";
    case arm_state_t::STATE_FAULT:
      return "fault";
    default:
      return "unknown";
  }
}

// Counts that each stand for a reason to look at.
constexpr std::array kRefusals{
    CommandRefusal::kOld,         CommandRefusal::kFromFuture,  CommandRefusal::kClockUnknown,
    CommandRefusal::kOtherArm,    CommandRefusal::kNotFinite,   CommandRefusal::kOffLine,
    CommandRefusal::kExpired,     CommandRefusal::kReplayed,    CommandRefusal::kOtherPublisher,
    CommandRefusal::kNotOperator, CommandRefusal::kUnknownMode, CommandRefusal::kFollowsItself};

}  // namespace

ArmServiceParams ArmService::read_params(Config& config) {
  ArmServiceParams params;
  ArmControllerParams& controller = params.controller;
  constexpr std::array<std::string_view, 2> kModes{"commanded", "follow"};
  constexpr std::array<std::string_view, 1> kBackEnds{"simulated"};
  std::string mode(kModes[0]);
  std::string back_end(kBackEnds[0]);
  std::string table_file;
  config.read_choice("arm.mode", mode, kModes);
  config.read_choice("arm.back_end", back_end, kBackEnds);
  config.read("arm.table", table_file);
  config.read("arm.margin_m", controller.margin_m, 0, 1);
  config.read("arm.state_hz", params.state_hz, 10, 1000);
  config.read("arm.line_x_m", controller.line_x_m, 0, 10);
  config.read("arm.line_half_m", controller.guard.line_half_m, 0.001, 10);
  config.read("arm.excess_m", controller.guard.excess_m, 0, 0.1);
  std::int64_t dead_man_ms = controller.guard.dead_man_us / 1000;
  config.read("arm.dead_man_ms", dead_man_ms, 1, 100);
  controller.guard.dead_man_us = controller.track.dead_man_us = dead_man_ms * 1000;
  std::int64_t clock_error_ms = controller.guard.max_clock_error_us / 1000;
  config.read("arm.max_clock_error_ms", clock_error_ms, 1, 200);
  controller.guard.max_clock_error_us = clock_error_ms * 1000;
  controller.track.max_clock_error_us = clock_error_ms * 1000;
  config.read("arm.max_speed_m_s", controller.arm.max_speed_m_s, 0.001, 20);
  config.read("arm.max_acceleration_m_s2", controller.arm.max_acceleration_m_s2, 0.01, 1000);
  config.read("arm.max_jerk_m_s3", controller.arm.max_jerk_m_s3, 1, 100000);

  if (mode == "follow") {
    if (table_file.empty()) config.fail("arm.table", "is needed when arm.mode is \"follow\"");
    controller.mode = ArmMode::kFollow;
    const TableCalibration table = read_table_file(table_file);
    controller.view = ArmView{table.table_from_image, table.geometry};
  }
  return params;
}

ArmService::ArmService(const ArmServiceParams& params, ServiceContext& context)
    : context_(context),
      controller_(params.controller, context.bus.session()),
      state_period_us_(static_cast<std::int64_t>(1e6 / params.state_hz)) {
  context_.peers.need({"puck-tracker"});
  if (params.controller.mode == ArmMode::kCommanded) context_.peers.need({"puck-bridge"});
  context_.bus.subscribe<arm_command_t>([this](const arm_command_t& command, const Receipt& at) {
    controller_.hear(command, {at.utime, at.monotonic_us},
                     context_.status.clock_of(command.session));
  });
  context_.bus.subscribe<puck_estimate_t>(
      [this](const puck_estimate_t& estimate, const Receipt& at) {
        controller_.hear(estimate, {at.utime, at.monotonic_us},
                         context_.status.clock_of(estimate.session));
      });
}

void ArmService::run(std::stop_token stop) {
  next_step_us_ = next_state_us_ = host_monotonic_us();
  while (!stop.stop_requested()) {
    context_.bus.handle(kHandle);
    const HostNow now = host_now();
    step_until(now);
    publish_state(now);
    warn_of_refusals();
    poll_status(context_, *this);
  }
}

void ArmService::step_until(const HostNow& now) {
  if (now.monotonic_us - next_step_us_ > kLongestPauseUs) {
    time_skipped_us_ += now.monotonic_us - next_step_us_;
    context_.limited_log.warn("pause", "the arm's loop could not run for more than 100 ms");
    next_step_us_ = now.monotonic_us;
  }
  for (; next_step_us_ <= now.monotonic_us; next_step_us_ += kStepUs) {
    controller_.step(now, kStepS);
  }
}

void ArmService::publish_state(const HostNow& now) {
  if (now.monotonic_us < next_state_us_) return;
  next_state_us_ = std::max(next_state_us_ + state_period_us_, now.monotonic_us);
  arm_state_t state = controller_.state();
  follow_state(state);
  context_.bus.publish(state);
}

void ArmService::follow_state(const arm_state_t& state) {
  const bool latched =
      state.state == arm_state_t::STATE_STOPPED || state.state == arm_state_t::STATE_FAULT;
  if (latched) {
    context_.status.set_state(ServiceState::kDegraded, state.reason);
  } else if (state.state == arm_state_t::STATE_IDLE) {
    context_.status.set_state(ServiceState::kWaiting, state.reason);
  } else {
    context_.status.set_state(ServiceState::kRunning);
  }
  // Moving and holding alternate all the time in a game.
  const bool was_playing =
      logged_state_ == arm_state_t::STATE_MOVING || logged_state_ == arm_state_t::STATE_HOLDING;
  const bool plays =
      state.state == arm_state_t::STATE_MOVING || state.state == arm_state_t::STATE_HOLDING;
  if (state.state == logged_state_) return;
  const auto level = was_playing && plays ? spdlog::level::debug : spdlog::level::info;
  context_.log.log(level, "{}{}{}", name_of(state.state), state.reason.empty() ? "" : ": ",
                   state.reason);
  logged_state_ = state.state;
}

void ArmService::warn_of_refusals() {
  const std::int64_t refused = controller_.guard().refused();
  if (refused == refused_before_) return;
  refused_before_ = refused;
  std::string text = std::to_string(refused) + " commands refused so far:";
  for (const CommandRefusal refusal : kRefusals) {
    const std::int64_t count = controller_.guard().refused(refusal);
    if (count > 0) text += std::string(" ") + to_string(refusal) + " " + std::to_string(count);
  }
  context_.limited_log.warn("refused", text);
}

void ArmService::report(StatusReport& report) const {
  using Verdict = TrackWatch::Verdict;
  report.counters = {
      {"commands_accepted", controller_.guard().accepted()},
      {"commands_refused", controller_.guard().refused()},
      {"estimates_used", controller_.estimates(Verdict::kUsed)},
      {"estimates_late", controller_.estimates(Verdict::kLate)},
      {"estimates_of_others", controller_.estimates(Verdict::kOtherPublisher)},
      {"estimates_wrong_clock", controller_.estimates(Verdict::kClock)},
      {"estimates_clock_unknown", controller_.estimates(Verdict::kClockUnknown)},
      {"estimates_malformed", controller_.estimates(Verdict::kMalformed)},
      {"faults", controller_.guard().faults()},
      {"time_skipped_us", time_skipped_us_},
  };
  for (const CommandRefusal refusal : kRefusals) {
    report.counters.emplace_back(std::string("refused_") + to_string(refusal),
                                 controller_.guard().refused(refusal));
  }
  const LatencySummary latency = controller_.estimate_to_motion().summary();
  report.latencies = {
      {"estimate_to_motion", latency.p50_us, latency.p99_us, latency.max_us, latency.samples}};
}

}  // namespace puck
