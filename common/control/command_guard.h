#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/messaging/channels.h"
#include "common/messaging/clock_offset.h"
#include "common/messaging/host_now.h"
#include "common/messaging/single_publisher.h"

namespace puck {

struct CommandGuardParams {
  double line_half_m = 0.30;  ///< The mallet's centre moves between plus and minus this.
  /// Targets up to so much beyond an end of the line are taken as that end; further ones are
  /// refused.
  double excess_m = 0.02;
  /// No command counts for longer than this after its receipt, whatever it says.
  std::int64_t dead_man_us = 100'000;
  /// Of a command's utime, by its sender's clock: a replayed log must not move the arm.
  std::int64_t max_clock_error_us = 200'000;
  bool takes_targets = true;  ///< False: only stop and reset are obeyed.
};

/// Why a command was refused. Each has a counter.
enum class CommandRefusal : std::uint8_t {
  kNone,
  kOld,           ///< By its own clock.
  kFromFuture,    ///< By its own clock.
  kClockUnknown,  ///< Nobody can say how old it is: its sender's clock is not known (well enough).
  kOtherArm,      ///< Answers another session than this arm's.
  kNotFinite,
  kOffLine,
  kExpired,         ///< Valid for no time at all.
  kReplayed,        ///< Not newer than the command before, or a reset that was used already.
  kOtherPublisher,  ///< Another publisher is obeyed.
  kNotOperator,     ///< Only a person may reset.
  kUnknownMode,
  kFollowsItself,  ///< The arm takes no targets: it follows the estimates.
};
inline constexpr std::size_t kCommandRefusals = 13;

/// `old`, `from_future`, …: as in the names of counters.
const char* to_string(CommandRefusal refusal);

/// Decides which commands count. A stop always stops and stays until an operator's reset. One
/// thread.
class CommandGuard {
 public:
  enum class Latch : std::uint8_t { kNone, kStopped, kFault };
  struct Current {
    arm_command_t command{};
    double target_m = 0;        ///< On the line.
    std::int64_t until_us = 0;  ///< CLOCK_MONOTONIC.
  };

  /// `arm_session`: that commands have to answer. Throws std::invalid_argument that names the key
  /// when a value is out of its range.
  CommandGuard(const CommandGuardParams& params, std::int64_t arm_session);

  /// `sender`: the clock of the command's session.
  CommandRefusal hear(const arm_command_t& command, const HostNow& now, const SenderClock& sender);
  /// Something is wrong with the arm itself.
  void fault(const std::string& reason);

  /// The command that counts now: neither stopped, nor refused, nor out of time.
  const Current* current(std::int64_t monotonic_us) const;
  bool was_ever_commanded() const { return was_ever_commanded_; }
  Latch latch() const { return latch_; }
  const std::string& latch_reason() const { return latch_reason_; }
  /// The newest stop since the last reset: that it was heard is what its sender wants to know.
  struct Stop {
    std::int64_t session = 0;  ///< 0: none.
    std::int64_t seq = 0;
  };
  const Stop& stop() const { return stop_; }

  std::int64_t accepted() const { return accepted_; }
  std::int64_t refused(CommandRefusal refusal) const {
    return refused_[static_cast<std::size_t>(refusal)];
  }
  std::int64_t refused() const;
  std::int32_t faults() const { return faults_; }

 private:
  CommandRefusal judge(const arm_command_t& command, const HostNow& now, const SenderClock& sender);
  CommandRefusal judge_reset(const arm_command_t& command, const HostNow& now,
                             const SenderClock& sender);
  CommandRefusal judge_clock_and_arm(const arm_command_t& command, const HostNow& now,
                                     const SenderClock& sender) const;

  CommandGuardParams params_;
  std::int64_t arm_session_;
  SinglePublisher publisher_;
  std::optional<Current> current_;
  bool was_ever_commanded_ = false;
  Latch latch_ = Latch::kNone;
  std::string latch_reason_;
  Stop stop_;
  std::array<std::int64_t, 16> used_resets_{};  // sessions of the newest that released: a ring
  std::size_t next_used_reset_ = 0;
  std::int64_t accepted_ = 0;
  std::int32_t faults_ = 0;
  std::array<std::int64_t, kCommandRefusals> refused_{};
};

}  // namespace puck
