#include "common/control/arm_controller.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace puck {
namespace {

// Below this speed, with its set-point at rest, the arm counts as holding.
constexpr double kStillMS = 0.005;
// Without the kind of latch and its reason: a reset may come before the next step.
constexpr const char* kLatched = "not reset yet";

CommandGuardParams guard_params(const ArmControllerParams& params) {
  CommandGuardParams guard = params.guard;
  guard.takes_targets = params.mode == ArmMode::kCommanded;
  return guard;
}

}  // namespace

ArmController::ArmController(const ArmControllerParams& params, std::int64_t session,
                             std::unique_ptr<ArmBackEnd> back_end)
    : params_(params),
      guard_(guard_params(params), session),
      track_(params.track),
      jumps_(params.jumps),
      motion_(params.arm, params.guard.line_half_m),
      back_end_(std::move(back_end)) {
  if (params_.mode == ArmMode::kFollow && !params_.view) {
    throw std::invalid_argument("arm.table is needed when arm.mode is \"follow\"");
  }
  if (!back_end_) {
    back_end_ = std::make_unique<SimulatedBackEnd>(params.simulated, motion_.table(),
                                                   joints_at(motion_.table(), 0));
  }
  order_.reason = "no command yet";
}

void ArmController::hear(const PublishedEstimate& estimate, const HostNow& now,
                         const SenderClock& sender) {
  const TrackWatch::Verdict verdict = track_.hear(estimate, now, sender);
  ++estimates_[static_cast<std::size_t>(verdict)];
  if (params_.mode != ArmMode::kFollow || verdict != TrackWatch::Verdict::kUsed) return;
  // After an interruption of the track the jump check allows for the time that passed.
  const PublishedEstimate* track = track_.alive(now.monotonic_us);
  if (track == nullptr) return;
  const std::optional<TablePoint> point = place_of(*track);
  if (!point) {
    ++off_table_;
    return;
  }
  jumps_.see(*point, track->newest_event.us, now.monotonic_us);
}

ArmController::Order ArmController::decide_as_commanded(const HostNow& now,
                                                        const PublishedEstimate* track) const {
  Order order;
  const CommandGuard::Current* current = guard_.current(now.monotonic_us);
  if (current == nullptr) {
    order.reason = guard_.was_ever_commanded() ? "no fresh command" : "no command yet";
    return order;
  }
  const ArmCommand& command = current->command;
  order.command = command.id();
  order.estimate = command.estimate;
  if (command.mode == CommandMode::kHold) {
    order.reason = "asked to hold";
  } else if (track == nullptr) {
    order.reason = "no live track";
  } else if (track->session != command.estimate.session) {
    order.reason = "the command is based on another tracker than the one heard here";
  } else {
    order.target_m = current->target_m;
  }
  return order;
}

std::optional<TablePoint> ArmController::place_of(const PublishedEstimate& track) const {
  const std::optional<TablePoint> point = params_.view->table_from_image.to_table(*track.position);
  if (!point || !params_.view->table.contains(*point, params_.margin_m)) return std::nullopt;
  return point;
}

ArmController::Order ArmController::decide_to_follow(const PublishedEstimate* track,
                                                     const HostNow& now) const {
  Order order;
  if (track == nullptr) {
    order.reason = "no live track";
    return order;
  }
  const std::optional<TablePoint> point = place_of(*track);
  if (!point) {
    order.reason = "the track is off the table";
    return order;
  }
  if (!jumps_.is_believed(now.monotonic_us)) {
    order.reason = "the track jumps";
    return order;
  }
  const double half_m = params_.guard.line_half_m;
  order.target_m = std::clamp(point->y_m, -half_m, half_m);
  order.estimate = track->id();
  return order;
}

ArmController::Order ArmController::decide(const HostNow& now,
                                           const PublishedEstimate* track) const {
  const bool is_latched = guard_.latch() != CommandGuard::Latch::kNone;
  if (is_latched || is_ending_) {
    Order order;
    order.reason = is_latched ? kLatched : "shutting down";
    return order;
  }
  return params_.mode == ArmMode::kFollow ? decide_to_follow(track, now)
                                          : decide_as_commanded(now, track);
}

void ArmController::measure_latency(const Order& order, const HostNow& now) {
  if (!order.target_m || order.rests_on_the_same_as(order_)) return;
  const std::optional<std::int64_t> published = track_.published_utime(order.estimate);
  if (!published) return;
  // Below 0 only by the uncertainty of the clocks' offset.
  estimate_to_motion_us_ = std::max<std::int64_t>(0, now.utime - *published);
  estimate_to_motion_.record(estimate_to_motion_us_);
}

void ArmController::step(const HostNow& now, double dt_s) {
  const PublishedEstimate* track = track_.alive(now.monotonic_us);
  const Order order = decide(now, track);
  measure_latency(order, now);
  alive_ = track != nullptr ? track->id() : MessageId{};
  order_ = order;

  if (order_.target_m) was_ever_ordered_ = true;

  const bool is_faulty = guard_.latch() == CommandGuard::Latch::kFault;
  if (was_faulty_ && !is_faulty) motion_.restart();
  was_faulty_ = is_faulty;
  const bool is_latched = guard_.latch() != CommandGuard::Latch::kNone;
  const std::string wrong =
      motion_.step(*back_end_, order_.target_m, now.monotonic_us, dt_s, !is_latched);
  if (wrong.empty()) return;
  guard_.fault(wrong);
  was_faulty_ = true;
  order_ = {};
  order_.reason = kLatched;
}

ArmState ArmController::state() const {
  const double half_m = params_.guard.line_half_m;
  ArmState state;
  const bool is_latched = guard_.latch() != CommandGuard::Latch::kNone;
  if (is_latched) {
    state.reason = guard_.latch_reason();
  } else if (order_.target_m || motion_.is_waiting()) {
    state.reason = motion_.note();
  } else {
    state.reason = order_.reason;
  }
  state.faults = guard_.faults();
  state.back_end = back_end_->name();
  state.line_x_m = params_.line_x_m;
  state.line_min_m = -half_m;
  state.line_max_m = half_m;
  state.position_m = position_m();
  state.position_normalised = position_m() / half_m;
  state.velocity_m_s = velocity_m_s();
  state.target_m = order_.target_m.value_or(motion_.line().target());
  if (motion_.encoders().has_reading()) {
    const JointAngles& joints = motion_.encoders().deg();
    state.joint_deg.assign(joints.deg().begin(), joints.deg().end());
    for (std::size_t k = 0; k < joints.size(); ++k) {
      state.joint_velocity_deg_s.push_back(motion_.encoders().joint_velocity_deg_s(k));
    }
  }
  state.command = is_latched ? guard_.stop() : order_.command;
  state.estimate = alive_;
  state.commands_refused = guard_.refused();
  state.estimate_to_motion_us = estimate_to_motion_us_;

  const bool there = motion_.line().is_at_rest() && (motion_.is_on_line() || !order_.target_m) &&
                     std::abs(state.velocity_m_s) < kStillMS;
  if (guard_.latch() == CommandGuard::Latch::kFault) {
    state.activity = ArmActivity::kFault;
  } else if (guard_.latch() == CommandGuard::Latch::kStopped) {
    state.activity = ArmActivity::kStopped;
  } else if (motion_.is_waiting()) {
    state.activity = ArmActivity::kIdle;
  } else if (!there) {
    state.activity = ArmActivity::kMoving;
  } else if (was_ever_ordered_ || guard_.was_ever_commanded()) {
    state.activity = ArmActivity::kHolding;
  } else {
    state.activity = ArmActivity::kIdle;
  }
  return state;
}

}  // namespace puck
