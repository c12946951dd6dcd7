#include "common/control/command_guard.h"

#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/control/arm_bench.h"

namespace puck {
namespace {

class GuardBench : public ArmBench {
 public:
  CommandRefusal hear(const ArmCommand& command) { return guard.hear(command, now, sender); }
  void pass(std::int64_t us) {
    now.utime += us;
    now.monotonic_us += us;
  }
  const CommandGuard::Current* current() const { return guard.current(now.monotonic_us); }

  CommandGuard guard{CommandGuardParams{}, kArmSession};
};

TEST_CASE("A good command is valid as long as it states, but for 100 ms at most") {
  GuardBench bench;
  ArmCommand command = bench.command(0.1);
  command.valid_for_us = 30'000;
  CHECK(bench.hear(command) == CommandRefusal::kNone);
  bench.pass(30'000);
  REQUIRE(bench.current() != nullptr);
  CHECK(bench.current()->target_m == 0.1);
  bench.pass(1);
  CHECK(bench.current() == nullptr);

  command = bench.command(0.1);
  command.valid_for_us = 3'600'000'000;
  CHECK(bench.hear(command) == CommandRefusal::kNone);
  bench.pass(100'000);
  CHECK(bench.current() != nullptr);
  bench.pass(1);
  CHECK(bench.current() == nullptr);
}

TEST_CASE("A command 200 ms old by its own clock is taken, older and future ones are refused") {
  GuardBench bench;
  ArmCommand command = bench.command(0);
  command.utime = bench.now.utime - 200'000;
  CHECK(bench.hear(command) == CommandRefusal::kNone);
  command = bench.command(0);
  command.utime = bench.now.utime - 200'001;
  CHECK(bench.hear(command) == CommandRefusal::kOld);
  command.utime = bench.now.utime + 200'001;
  CHECK(bench.hear(command) == CommandRefusal::kFromFuture);
  command.utime = std::numeric_limits<std::int64_t>::min();
  CHECK(bench.hear(command) == CommandRefusal::kOld);
  command.utime = std::numeric_limits<std::int64_t>::max();
  CHECK(bench.hear(command) == CommandRefusal::kFromFuture);
}

TEST_CASE("The age of a command is measured by its sender's clock, even hours away") {
  constexpr std::int64_t kHourUs = 3'600'000'000;
  for (const std::int64_t ahead_us : {5 * kHourUs, -5 * kHourUs}) {
    CAPTURE(ahead_us);
    GuardBench bench;
    bench.sender = ClockOffset{ahead_us, 5'000};
    CHECK(bench.hear(bench.command(0)) == CommandRefusal::kNone);
    ArmCommand command = bench.command(0);
    command.utime -= 195'000;
    CHECK(bench.hear(command) == CommandRefusal::kNone);
    // 5 ms older it may be 200 ms old, within the offset's bound.
    command = bench.command(0);
    command.utime -= 195'001;
    CHECK(bench.hear(command) == CommandRefusal::kOld);
    // A live time by our clock.
    command.utime = bench.now.utime;
    CHECK(bench.hear(command) ==
          (ahead_us > 0 ? CommandRefusal::kOld : CommandRefusal::kFromFuture));
  }
}

TEST_CASE("While its sender's clock is unknown, only a stop is obeyed") {
  GuardBench bench;
  for (const SenderClock& unknown : {SenderClock{}, SenderClock{ClockOffset{0, 200'001}}}) {
    bench.sender = ClockOffset{};
    ArmCommand command = bench.command(0.1);
    ArmCommand reset = bench.command(0);
    bench.sender = unknown;
    CHECK(bench.hear(command) == CommandRefusal::kClockUnknown);
    reset.mode = CommandMode::kReset;
    reset.from_operator = true;
    CHECK(bench.hear(reset) == CommandRefusal::kClockUnknown);
  }
  CHECK(bench.current() == nullptr);
  bench.sender = ClockOffset{};
  ArmCommand stop = bench.command(0);
  stop.mode = CommandMode::kStop;
  bench.sender = std::nullopt;
  CHECK(bench.hear(stop) == CommandRefusal::kNone);
  CHECK(bench.guard.latch() == CommandGuard::Latch::kStopped);
}

TEST_CASE("A command that answers another arm session is refused") {
  GuardBench bench;
  ArmCommand command = bench.command(0);
  command.arm_session = ArmBench::kArmSession + 1;
  CHECK(bench.hear(command) == CommandRefusal::kOtherArm);
  command.arm_session = 0;
  CHECK(bench.hear(command) == CommandRefusal::kOtherArm);
  CHECK(bench.current() == nullptr);
}

TEST_CASE("A target slightly beyond the line is clamped to its end, a distant one is refused") {
  GuardBench bench;
  CHECK(bench.hear(bench.command(0.32)) == CommandRefusal::kNone);
  CHECK(bench.current()->target_m == 0.30);
  CHECK(bench.hear(bench.command(-0.321)) == CommandRefusal::kOffLine);
  CHECK(bench.hear(bench.command(1e300)) == CommandRefusal::kOffLine);
  CHECK(bench.hear(bench.command(std::numeric_limits<double>::quiet_NaN())) ==
        CommandRefusal::kNotFinite);
  CHECK(bench.hear(bench.command(std::numeric_limits<double>::infinity())) ==
        CommandRefusal::kNotFinite);
  // A refused command does not replace an accepted one.
  CHECK(bench.current()->target_m == 0.30);
  CHECK(bench.guard.refused() == 4);
}

TEST_CASE("A duplicate or late command is a replay") {
  GuardBench bench;
  const ArmCommand first = bench.command(0);
  const ArmCommand second = bench.command(0);
  CHECK(bench.hear(second) == CommandRefusal::kNone);
  CHECK(bench.hear(second) == CommandRefusal::kReplayed);
  CHECK(bench.hear(first) == CommandRefusal::kReplayed);
}

TEST_CASE("Of two bridges the first is obeyed until it has been silent for 500 ms") {
  GuardBench bench;
  bench.hear(bench.command(0));
  bench.pass(500'000);
  ArmCommand other = bench.command(0.1);
  other.session = 77;
  CHECK(bench.hear(other) == CommandRefusal::kOtherPublisher);
  bench.pass(1);
  other.utime = bench.now.utime;
  CHECK(bench.hear(other) == CommandRefusal::kNone);
}

TEST_CASE("A command without validity, or with an unknown mode, is refused") {
  GuardBench bench;
  ArmCommand command = bench.command(0);
  command.valid_for_us = 0;
  CHECK(bench.hear(command) == CommandRefusal::kExpired);
  command.valid_for_us = -5;
  CHECK(bench.hear(command) == CommandRefusal::kExpired);
  command.mode = static_cast<CommandMode>(17);
  CHECK(bench.hear(command) == CommandRefusal::kUnknownMode);
}

TEST_CASE("A stop always stops: from any sender, to any arm, of any age, repeated or malformed") {
  GuardBench bench;
  bench.hear(bench.command(0.1));
  ArmCommand stop = bench.command(std::numeric_limits<double>::quiet_NaN());
  stop.mode = CommandMode::kStop;
  stop.utime = 0;
  stop.seq = 0;
  stop.session = 5;
  stop.arm_session = 1;
  stop.valid_for_us = -1;
  CHECK(bench.hear(stop) == CommandRefusal::kNone);
  CHECK(bench.guard.latch() == CommandGuard::Latch::kStopped);
  CHECK(bench.current() == nullptr);
  CHECK(bench.hear(bench.command(0.1)) == CommandRefusal::kNone);
  CHECK(bench.current() == nullptr);
}

TEST_CASE("Only an operator's fresh reset to this arm releases a stop; then commands restart") {
  GuardBench bench;
  ArmCommand stop = bench.command(0);
  stop.mode = CommandMode::kStop;
  bench.hear(stop);
  bench.hear(bench.command(0.1));

  ArmCommand reset = bench.command(0);
  reset.mode = CommandMode::kReset;
  reset.session = 5;
  CHECK(bench.hear(reset) == CommandRefusal::kNotOperator);
  reset.from_operator = true;
  reset.utime = bench.now.utime - 300'000;
  CHECK(bench.hear(reset) == CommandRefusal::kOld);
  reset.utime = bench.now.utime;
  reset.arm_session = 0;
  CHECK(bench.hear(reset) == CommandRefusal::kOtherArm);
  CHECK(bench.guard.latch() == CommandGuard::Latch::kStopped);
  reset.arm_session = ArmBench::kArmSession;
  CHECK(bench.hear(reset) == CommandRefusal::kNone);
  CHECK(bench.guard.latch() == CommandGuard::Latch::kNone);
  CHECK(bench.current() == nullptr);
  CHECK(bench.hear(bench.command(0.1)) == CommandRefusal::kNone);
  CHECK(bench.current() != nullptr);
}

TEST_CASE("Repetitions of a reset do not release a later stop") {
  GuardBench bench;
  ArmCommand stop = bench.command(0);
  stop.mode = CommandMode::kStop;
  ArmCommand reset = bench.command(0);
  reset.mode = CommandMode::kReset;
  reset.from_operator = true;
  reset.session = 5;
  bench.hear(stop);
  CHECK(bench.hear(reset) == CommandRefusal::kNone);
  bench.hear(stop);
  reset.seq += 1;
  CHECK(bench.hear(reset) == CommandRefusal::kReplayed);
  CHECK(bench.guard.latch() == CommandGuard::Latch::kStopped);
}

TEST_CASE("Two operators with alternating resets release one stop each, and no later one") {
  GuardBench bench;
  ArmCommand stop = bench.command(0);
  stop.mode = CommandMode::kStop;
  ArmCommand reset = bench.command(0);
  reset.mode = CommandMode::kReset;
  reset.from_operator = true;
  for (const std::int64_t operator_session : {5, 6}) {
    reset.session = operator_session;
    bench.hear(stop);
    CHECK(bench.hear(reset) == CommandRefusal::kNone);
  }
  bench.hear(stop);
  for (const std::int64_t operator_session : {5, 6, 5}) {
    reset.session = operator_session;
    CHECK(bench.hear(reset) == CommandRefusal::kReplayed);
    CHECK(bench.guard.latch() == CommandGuard::Latch::kStopped);
  }
}

TEST_CASE("A fault latches until a reset and persists after a stop") {
  GuardBench bench;
  bench.guard.fault("encoder silent");
  bench.guard.fault("encoder silent");
  CHECK(bench.guard.faults() == 1);
  ArmCommand stop = bench.command(0);
  stop.mode = CommandMode::kStop;
  bench.hear(stop);
  CHECK(bench.guard.latch() == CommandGuard::Latch::kFault);
  CHECK(bench.guard.latch_reason() == "encoder silent");
  bench.hear(bench.command(0.1));
  CHECK(bench.current() == nullptr);
}

TEST_CASE("The dead-man's limit cannot be set above 100 ms") {
  CommandGuardParams params;
  params.dead_man_us = 100'001;
  CHECK_THROWS_WITH_AS(CommandGuard(params, 1), "arm.dead_man_ms must be above 0 and at most 100",
                       std::invalid_argument);
}

}  // namespace
}  // namespace puck
