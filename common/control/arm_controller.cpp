#include "common/control/arm_controller.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace puck {
namespace {

// Nearer to its target and slower than this the arm counts as holding.
constexpr double kThereM = 0.002;
constexpr double kStillMS = 0.005;

CommandGuardParams guard_params(const ArmControllerParams& params) {
  CommandGuardParams guard = params.guard;
  guard.takes_targets = params.mode == ArmMode::kCommanded;
  return guard;
}

}  // namespace

ArmController::ArmController(const ArmControllerParams& params, std::int64_t session)
    : params_(params),
      guard_(guard_params(params), session),
      track_(params.track),
      arm_(params.arm, params.guard.line_half_m) {
  if (params_.mode == ArmMode::kFollow && !params_.view) {
    throw std::invalid_argument("arm.table is needed when arm.mode is \"follow\"");
  }
  order_.reason = "nothing asked yet";
}

void ArmController::hear(const puck_estimate_t& estimate, const HostNow& now,
                         const SenderClock& sender) {
  ++estimates_[static_cast<std::size_t>(track_.hear(estimate, now, sender))];
}

ArmController::Order ArmController::decide_as_commanded(const HostNow& now,
                                                        const puck_estimate_t* track) const {
  Order order;
  const CommandGuard::Current* current = guard_.current(now.monotonic_us);
  if (current == nullptr) {
    order.reason = guard_.was_ever_commanded() ? "no command in time" : "nothing asked yet";
    return order;
  }
  const arm_command_t& command = current->command;
  order.command_session = command.session;
  order.command_seq = command.seq;
  order.estimate_session = command.estimate_session;
  order.estimate_seq = command.estimate_seq;
  if (command.mode == arm_command_t::MODE_HOLD) {
    order.reason = "asked to hold";
  } else if (track == nullptr) {
    order.reason = "no live track";
  } else if (track->session != command.estimate_session) {
    order.reason = "the command rests on another tracker";
  } else {
    order.target_m = current->target_m;
  }
  return order;
}

ArmController::Order ArmController::decide_to_follow(const puck_estimate_t* track) const {
  Order order;
  if (track == nullptr) {
    order.reason = "no live track";
    return order;
  }
  const std::optional<TablePoint> point =
      params_.view->table_from_image.to_table({track->x_px, track->y_px});
  if (!point || !params_.view->table.contains(*point, params_.margin_m)) {
    order.reason = "the track is off the table";
    return order;
  }
  const double half_m = params_.guard.line_half_m;
  order.target_m = std::clamp(point->y_m, -half_m, half_m);
  order.estimate_session = track->session;
  order.estimate_seq = track->seq;
  return order;
}

ArmController::Order ArmController::decide(const HostNow& now) const {
  if (guard_.latch() != CommandGuard::Latch::kNone) {
    Order order;
    order.reason = guard_.latch_reason();
    return order;
  }
  const puck_estimate_t* track = track_.alive(now.monotonic_us);
  return params_.mode == ArmMode::kFollow ? decide_to_follow(track)
                                          : decide_as_commanded(now, track);
}

void ArmController::measure_latency(const Order& order, const HostNow& now) {
  if (!order.target_m || order.rests_on_the_same_as(order_)) return;
  const std::optional<std::int64_t> published =
      track_.published_utime(order.estimate_session, order.estimate_seq);
  if (!published) return;
  // The offset of two clocks is never known to the last microsecond.
  estimate_to_motion_us_ = std::max<std::int64_t>(0, now.utime - *published);
  estimate_to_motion_.record(estimate_to_motion_us_);
}

void ArmController::step(const HostNow& now, double dt_s) {
  const Order order = decide(now);
  measure_latency(order, now);
  const puck_estimate_t* track = track_.alive(now.monotonic_us);
  alive_session_ = track != nullptr ? track->session : 0;
  alive_seq_ = track != nullptr ? track->seq : 0;
  order_ = order;

  if (order_.target_m) {
    was_ever_ordered_ = true;
    arm_.set_target(*order_.target_m);
  } else {
    arm_.hold();
  }
  arm_.step(dt_s);
  if (!std::isfinite(arm_.position_m())) guard_.fault("the arm's position is not finite");
}

arm_state_t ArmController::state() const {
  const double half_m = params_.guard.line_half_m;
  arm_state_t state{};
  state.reason = order_.target_m ? "" : order_.reason;
  state.faults = guard_.faults();
  state.back_end = "simulated";
  state.line_x_m = params_.line_x_m;
  state.line_min_m = -half_m;
  state.line_max_m = half_m;
  state.position_m = arm_.position_m();
  state.position_normalised = arm_.position_m() / half_m;
  state.velocity_m_s = arm_.velocity_m_s();
  state.target_m = order_.target_m.value_or(arm_.position_m());
  state.command_session = order_.command_session;
  state.command_seq = order_.command_seq;
  state.estimate_session = alive_session_;
  state.estimate_seq = alive_seq_;
  state.commands_refused = guard_.refused();
  state.estimate_to_motion_us = estimate_to_motion_us_;

  const bool there = std::abs(state.target_m - state.position_m) < kThereM &&
                     std::abs(state.velocity_m_s) < kStillMS;
  if (guard_.latch() == CommandGuard::Latch::kFault) {
    state.state = arm_state_t::STATE_FAULT;
  } else if (guard_.latch() == CommandGuard::Latch::kStopped) {
    state.state = arm_state_t::STATE_STOPPED;
  } else if (!there) {
    state.state = arm_state_t::STATE_MOVING;
  } else if (was_ever_ordered_ || guard_.was_ever_commanded()) {
    state.state = arm_state_t::STATE_HOLDING;
  } else {
    state.state = arm_state_t::STATE_IDLE;
  }
  return state;
}

}  // namespace puck
