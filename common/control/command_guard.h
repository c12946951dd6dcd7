#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/messages/arm_command.h"
#include "common/messages/clock_offset.h"
#include "common/messages/host_now.h"
#include "common/messages/single_publisher.h"

namespace puck {

struct CommandGuardParams {
  double line_half_m = 0.30;  ///< The mallet's centre stays within plus and minus this.
  /// Targets up to this far beyond an end of the line are clamped to the end; further ones are
  /// refused.
  double excess_m = 0.02;
  /// Longest validity of a command after its receipt, whatever the command says.
  std::int64_t dead_man_us = 100'000;
  /// Limit for the age of a command's utime, so that a replayed log moves no arm.
  std::int64_t max_clock_error_us = 200'000;
  bool takes_targets = true;  ///< False: only stop and reset are obeyed.
};

/// Reason of a refusal. Each has a counter.
enum class CommandRefusal : std::uint8_t {
  kNone,
  kOld,           ///< Too old by the sender's clock.
  kFromFuture,    ///< From the future by the sender's clock.
  kClockUnknown,  ///< The age is not known: the sender's clock is unknown or too uncertain.
  kOtherArm,      ///< For another session than this arm's.
  kNotFinite,
  kOffLine,
  kExpired,         ///< Its validity is not above 0.
  kReplayed,        ///< Not newer than the previous command, or a reset that was used already.
  kOtherPublisher,  ///< Another publisher is obeyed.
  kNotOperator,     ///< A reset that is not from an operator.
  kUnknownMode,
  kFollowsItself,  ///< The arm takes no targets: it follows ESTIMATE.
};
inline constexpr std::size_t kCommandRefusals = 13;

/// `old`, `from_future`, …: as in the names of counters.
const char* to_string(CommandRefusal refusal);

/// Decides which commands are obeyed. A stop lasts until an operator's reset. One thread.
class CommandGuard {
 public:
  enum class Latch : std::uint8_t { kNone, kStopped, kFault };
  struct Current {
    ArmCommand command;
    double target_m = 0;        ///< Position on the line.
    std::int64_t until_us = 0;  ///< End of validity, CLOCK_MONOTONIC.
  };

  /// `arm_session`: the session that commands must name. Throws std::invalid_argument that names
  /// the key when a value is out of its range.
  CommandGuard(const CommandGuardParams& params, std::int64_t arm_session);

  /// `sender`: the clock of the command's session.
  CommandRefusal hear(const ArmCommand& command, const HostNow& now, const SenderClock& sender);
  /// Latches a fault of the arm itself.
  void fault(const std::string& reason);

  /// The valid command; null without one and while the arm is stopped or at fault.
  const Current* current(std::int64_t monotonic_us) const;
  bool was_ever_commanded() const { return was_ever_commanded_; }
  Latch latch() const { return latch_; }
  const std::string& latch_reason() const { return latch_reason_; }
  /// The newest stop since the last reset, published to confirm it to its sender.
  const MessageId& stop() const { return stop_; }

  std::int64_t accepted() const { return accepted_; }
  std::int64_t refused(CommandRefusal refusal) const {
    return refused_[static_cast<std::size_t>(refusal)];
  }
  std::int64_t refused() const;
  std::int32_t faults() const { return faults_; }

 private:
  CommandRefusal judge(const ArmCommand& command, const HostNow& now, const SenderClock& sender);
  CommandRefusal judge_reset(const ArmCommand& command, const HostNow& now,
                             const SenderClock& sender);
  CommandRefusal judge_clock_and_arm(const ArmCommand& command, const HostNow& now,
                                     const SenderClock& sender) const;

  CommandGuardParams params_;
  std::int64_t arm_session_;
  SinglePublisher publisher_;
  std::optional<Current> current_;
  bool was_ever_commanded_ = false;
  Latch latch_ = Latch::kNone;
  std::string latch_reason_;
  MessageId stop_;
  std::array<std::int64_t, 16> used_resets_{};  // ring of the newest sessions whose reset was used
  std::size_t next_used_reset_ = 0;
  std::int64_t accepted_ = 0;
  std::int32_t faults_ = 0;
  std::array<std::int64_t, kCommandRefusals> refused_{};
};

}  // namespace puck
