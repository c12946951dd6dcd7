#include "common/control/command_guard.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace puck {

const char* to_string(CommandRefusal refusal) {
  switch (refusal) {
    case CommandRefusal::kNone:
      return "none";
    case CommandRefusal::kOld:
      return "old";
    case CommandRefusal::kFromFuture:
      return "from_future";
    case CommandRefusal::kClockUnknown:
      return "clock_unknown";
    case CommandRefusal::kOtherArm:
      return "other_arm";
    case CommandRefusal::kNotFinite:
      return "not_finite";
    case CommandRefusal::kOffLine:
      return "off_line";
    case CommandRefusal::kExpired:
      return "expired";
    case CommandRefusal::kReplayed:
      return "replayed";
    case CommandRefusal::kOtherPublisher:
      return "other_publisher";
    case CommandRefusal::kNotOperator:
      return "not_operator";
    case CommandRefusal::kUnknownMode:
      return "unknown_mode";
    case CommandRefusal::kFollowsItself:
      return "follows_itself";
  }
  return "unknown";
}

CommandGuard::CommandGuard(const CommandGuardParams& params, std::int64_t arm_session)
    : params_(params), arm_session_(arm_session) {
  if (!(params_.line_half_m > 0 && params_.line_half_m <= 10)) {
    throw std::invalid_argument("arm.line_half_m must be above 0 and at most 10, got " +
                                std::to_string(params_.line_half_m));
  }
  if (!(params_.excess_m >= 0 && params_.excess_m <= 0.1)) {
    throw std::invalid_argument("arm.excess_m must be between 0 and 0.1, got " +
                                std::to_string(params_.excess_m));
  }
  if (params_.dead_man_us < 1 || params_.dead_man_us > 100'000) {
    throw std::invalid_argument("arm.dead_man_ms must be above 0 and at most 100");
  }
}

std::int64_t CommandGuard::refused() const {
  return std::accumulate(refused_.begin(), refused_.end(), std::int64_t{0});
}

CommandRefusal CommandGuard::hear(const ArmCommand& command, const HostNow& now,
                                  const SenderClock& sender) {
  const CommandRefusal refusal = judge(command, now, sender);
  if (refusal == CommandRefusal::kNone) {
    ++accepted_;
  } else {
    ++refused_[static_cast<std::size_t>(refusal)];
  }
  return refusal;
}

void CommandGuard::fault(const std::string& reason) {
  if (latch_ == Latch::kFault) return;
  latch_ = Latch::kFault;
  latch_reason_ = reason;
  ++faults_;
  current_.reset();
}

CommandRefusal CommandGuard::judge_clock_and_arm(const ArmCommand& command, const HostNow& now,
                                                 const SenderClock& sender) const {
  if (command.arm_session != arm_session_) return CommandRefusal::kOtherArm;
  switch (freshness_of(command.utime, now, sender, params_.max_clock_error_us)) {
    case Freshness::kOld:
      return CommandRefusal::kOld;
    case Freshness::kFromFuture:
      return CommandRefusal::kFromFuture;
    case Freshness::kClockUnknown:
      return CommandRefusal::kClockUnknown;
    case Freshness::kOfNow:
      break;
  }
  return CommandRefusal::kNone;
}

CommandRefusal CommandGuard::judge_reset(const ArmCommand& command, const HostNow& now,
                                         const SenderClock& sender) {
  if (!command.from_operator) return CommandRefusal::kNotOperator;
  const CommandRefusal refusal = judge_clock_and_arm(command, now, sender);
  if (refusal != CommandRefusal::kNone) return refusal;
  // An operator's command is sent several times, and there may be several operators. Each run
  // resets once, so that its repetitions cannot undo a stop that comes in between.
  if (std::find(used_resets_.begin(), used_resets_.end(), command.session) != used_resets_.end()) {
    return latch_ == Latch::kNone ? CommandRefusal::kNone : CommandRefusal::kReplayed;
  }
  used_resets_[next_used_reset_] = command.session;
  next_used_reset_ = (next_used_reset_ + 1) % used_resets_.size();
  latch_ = Latch::kNone;
  latch_reason_.clear();
  stop_ = {};
  current_.reset();
  return CommandRefusal::kNone;
}

CommandRefusal CommandGuard::judge(const ArmCommand& command, const HostNow& now,
                                   const SenderClock& sender) {
  // A stop is always obeyed: from anyone, for any arm, of any age.
  if (command.mode == CommandMode::kStop) {
    current_.reset();
    stop_ = command.id();
    if (latch_ == Latch::kNone) {
      latch_ = Latch::kStopped;
      latch_reason_ = command.from_operator ? "stopped by an operator" : "stopped by a command";
    }
    return CommandRefusal::kNone;
  }
  if (command.mode == CommandMode::kReset) return judge_reset(command, now, sender);
  if (command.mode != CommandMode::kFollow && command.mode != CommandMode::kHold) {
    return CommandRefusal::kUnknownMode;
  }

  if (!params_.takes_targets) return CommandRefusal::kFollowsItself;
  const CommandRefusal refusal = judge_clock_and_arm(command, now, sender);
  if (refusal != CommandRefusal::kNone) return refusal;
  if (!std::isfinite(command.target_m) || !std::isfinite(command.target_normalised)) {
    return CommandRefusal::kNotFinite;
  }
  if (std::abs(command.target_m) > params_.line_half_m + params_.excess_m) {
    return CommandRefusal::kOffLine;
  }
  if (command.valid_for_us <= 0) return CommandRefusal::kExpired;
  switch (publisher_.hear(command.session, command.seq, now.monotonic_us)) {
    case SinglePublisher::Verdict::kLate:
      return CommandRefusal::kReplayed;
    case SinglePublisher::Verdict::kOtherPublisher:
      return CommandRefusal::kOtherPublisher;
    case SinglePublisher::Verdict::kNewPublisher:
    case SinglePublisher::Verdict::kAccepted:
      break;
  }
  was_ever_commanded_ = true;
  const double target_m = std::clamp(command.target_m, -params_.line_half_m, params_.line_half_m);
  current_ = {command, target_m,
              now.monotonic_us + std::min(command.valid_for_us, params_.dead_man_us)};
  return CommandRefusal::kNone;
}

const CommandGuard::Current* CommandGuard::current(std::int64_t monotonic_us) const {
  if (latch_ != Latch::kNone || !current_ || monotonic_us > current_->until_us) return nullptr;
  return &*current_;
}

}  // namespace puck
