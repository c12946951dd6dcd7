#include "services/arm/arm_service.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "common/messaging/conversions.h"
#include "services/arm/back_end.h"
#include "services/launch/real_time.h"

namespace puck {
namespace {

// After a longer pause without set-points the robot rests, and the motion starts from rest.
constexpr std::int64_t kPauseUs = 20'000;
// Longest time for messages before a step.
constexpr std::int64_t kLongestDrainUs = 500;
// Shortest sleep before each step, also in a flood: other processes need the processor.
constexpr std::int64_t kLeastWaitUs = 100;
// Braking takes 0.1 s with the built-in limits.
constexpr std::int64_t kLongestBrakeUs = 500'000;
// Shortest period of log lines on reasons for holding; others go to level debug.
constexpr std::int64_t kTellPeriodUs = 1'000'000;

const char* name_of(ArmActivity activity) {
  switch (activity) {
    case ArmActivity::kIdle:
      return "idle";
    case ArmActivity::kMoving:
      return "moving";
    case ArmActivity::kHolding:
      return "holding";
    case ArmActivity::kStopped:
      return "stopped";
    case ArmActivity::kFault:
      return "fault";
  }
  return "unknown";
}

bool plays(std::optional<ArmActivity> activity) {
  return activity == ArmActivity::kMoving || activity == ArmActivity::kHolding;
}

// Refusals that are worth a warning.
constexpr std::array kRefusals{
    CommandRefusal::kOld,         CommandRefusal::kFromFuture,  CommandRefusal::kClockUnknown,
    CommandRefusal::kOtherArm,    CommandRefusal::kNotFinite,   CommandRefusal::kOffLine,
    CommandRefusal::kExpired,     CommandRefusal::kReplayed,    CommandRefusal::kOtherPublisher,
    CommandRefusal::kNotOperator, CommandRefusal::kUnknownMode, CommandRefusal::kFollowsItself};

}  // namespace

ArmService::ArmService(const ArmServiceParams& params, ServiceContext& context)
    : context_(context),
      controller_(
          params.controller, context.bus.session(),
          make_back_end(params.back_end, params.controller, context.bus.is_authenticated())),
      real_time_priority_(params.real_time_priority),
      step_period_us_(std::llround(1e6 / params.loop_hz)),
      state_period_us_(std::llround(1e6 / params.state_hz)) {
  context_.peers.need({"puck-tracker"});
  if (params.controller.mode == ArmMode::kCommanded) context_.peers.need({"puck-bridge"});
  context_.bus.subscribe<ArmCommand>([this](const ArmCommand& command, const Receipt& at) {
    controller_.hear(command, {at.utime, at.monotonic_us},
                     context_.status.clock_of(command.session));
  });
  context_.bus.subscribe<PublishedEstimate>(
      [this](const PublishedEstimate& estimate, const Receipt& at) {
        controller_.hear(estimate, {at.utime, at.monotonic_us},
                         context_.status.clock_of(estimate.session));
      });
}

void ArmService::run(std::stop_token stop) {
  run_in_real_time_and_tell(real_time_priority_, context_.log);
  due_us_ = stepped_us_ = next_state_us_ = host_monotonic_us();
  while (!stop.stop_requested()) turn();
  brake();
}

void ArmService::turn() {
  wait_until_due();
  const HostNow now = host_now();
  step(now);
  publish_state(now);
  warn_of_refusals();
  poll_status(context_, *this);
}

// A sudden end of the set-points would stop the arm harder than its limits allow.
void ArmService::brake() {
  controller_.end();
  const std::int64_t end_us = host_monotonic_us() + kLongestBrakeUs;
  do {
    turn();
  } while (!controller_.rests() && host_monotonic_us() < end_us);
  if (!controller_.rests()) context_.log.warn("the service ends before the arm has come to rest");
}

// Messages do not change the motion before the step, and the kernel stamps their arrival. So the
// arm sleeps until then: waking up for every estimate would preempt their publisher.
void ArmService::wait_until_due() {
  due_us_ += step_period_us_;
  // A late step is not caught up with: set-points would come faster than the motion.
  due_us_ = std::max(due_us_, host_monotonic_us());
  // In a flood the last call left messages.
  if (!is_drained_) drain_until(due_us_ - kLeastWaitUs);
  std::this_thread::sleep_for(
      std::chrono::microseconds(std::max(due_us_ - host_monotonic_us(), kLeastWaitUs)));
  is_drained_ = drain_until(host_monotonic_us() + kLongestDrainUs);
}

bool ArmService::drain_until(std::int64_t end_us) {
  for (std::int64_t left_us = end_us - host_monotonic_us(); left_us > 0;
       left_us = end_us - host_monotonic_us()) {
    if (context_.bus.handle({}, std::chrono::microseconds(left_us)) == 0) return true;
  }
  return false;
}

void ArmService::step(const HostNow& now) {
  loop_jitter_.record(now.monotonic_us - due_us_);
  std::int64_t passed_us = now.monotonic_us - stepped_us_;
  stepped_us_ = now.monotonic_us;
  if (passed_us > kPauseUs) {
    ++pauses_;
    time_skipped_us_ += passed_us - step_period_us_;
    context_.limited_log.warn(
        "pause", "the arm's loop could not run for " + std::to_string(passed_us / 1000) + " ms");
    controller_.rest();
    passed_us = step_period_us_;
  }
  if (passed_us > 0) controller_.step(now, 1e-6 * static_cast<double>(passed_us));
}

void ArmService::publish_state(const HostNow& now) {
  if (now.monotonic_us < next_state_us_) return;
  next_state_us_ = std::max(next_state_us_ + state_period_us_, now.monotonic_us);
  ArmState state = controller_.state();
  follow_state(state);
  context_.bus.publish(state);
}

void ArmService::follow_state(const ArmState& state) {
  if (state.activity == logged_activity_ && state.reason == logged_reason_) return;
  const std::string text =
      std::string(name_of(state.activity)) + (state.reason.empty() ? "" : ": ") + state.reason;
  const bool is_fault = state.activity == ArmActivity::kFault;
  if (is_fault || state.activity == ArmActivity::kStopped) {
    context_.status.set_state(ServiceState::kDegraded, text);
  } else if (state.activity == ArmActivity::kIdle) {
    context_.status.set_state(ServiceState::kWaiting, text);
  } else {
    context_.status.set_state(ServiceState::kRunning, text);
  }
  const bool is_play = plays(logged_activity_) && plays(state.activity);
  const std::int64_t now_us = host_monotonic_us();
  auto level = is_fault ? spdlog::level::err : spdlog::level::info;
  // A game alternates between moving and holding; a bad track also changes the reasons.
  if (is_play && (state.reason.empty() || now_us - told_us_ < kTellPeriodUs)) {
    level = spdlog::level::debug;
  } else {
    told_us_ = now_us;
  }
  context_.log.log(level, text);
  logged_activity_ = state.activity;
  logged_reason_ = state.reason;
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
      {"faults", controller_.guard().faults()},
  };
  report.add_unless_zero("estimates_late", controller_.estimates(Verdict::kLate));
  report.add_unless_zero("estimates_of_others", controller_.estimates(Verdict::kOtherPublisher));
  report.add_unless_zero("estimates_wrong_clock", controller_.estimates(Verdict::kClock));
  report.add_unless_zero("estimates_clock_unknown", controller_.estimates(Verdict::kClockUnknown));
  report.add_unless_zero("estimates_stale", controller_.estimates(Verdict::kStale));
  report.add_unless_zero("estimates_malformed", controller_.estimates(Verdict::kMalformed));
  report.add_unless_zero("estimates_frozen", controller_.frozen_estimates());
  report.add_unless_zero("sensor_clock_disagreements", controller_.sensor_clock_disagreements());
  report.add_unless_zero("estimates_off_table", controller_.off_table_estimates());
  report.add_unless_zero("estimates_jumped", controller_.jumped_estimates());
  report.add_unless_zero("pauses", pauses_);
  report.add_unless_zero("time_skipped_us", time_skipped_us_);
  for (const CommandRefusal refusal : kRefusals) {
    report.add_unless_zero(std::string("refused_") + to_string(refusal),
                           controller_.guard().refused(refusal));
  }
  for (auto& counter : controller_.back_end().counters(host_monotonic_us())) {
    report.counters.push_back(std::move(counter));
  }
  const LatencySummary latency = controller_.estimate_to_motion().summary();
  const LatencySummary jitter = loop_jitter_.summary();
  report.latencies = {
      {"estimate_to_motion", latency.p50_us, latency.p99_us, latency.max_us, latency.samples},
      {"loop_jitter", jitter.p50_us, jitter.p99_us, jitter.max_us, jitter.samples}};
}

}  // namespace puck
