#include "services/arm/addressed_arms.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr std::int64_t kOperator = 77;
constexpr std::int64_t kOther = 78;
constexpr SenderClock kSameClock = ClockOffset{0, 100};

struct Bench {
  explicit Bench(CommandMode mode) : arms(mode, kOperator) {}

  void say(std::int64_t session, ArmActivity activity, std::int64_t command_session,
           const SenderClock& clock = kSameClock, std::int64_t age_us = 0) {
    ArmState message;
    message.session = session;
    message.utime = now.utime - age_us;
    message.activity = activity;
    message.command.session = command_session;
    arms.hear(message, now, clock);
  }

  bool is_confirmed() const { return arms.why_not(now).empty(); }

  HostNow now{1'700'000'000'000'000, 5'000'000};
  AddressedArms arms;
};

TEST_CASE("Only arms that heard a stop confirm it") {
  Bench bench(CommandMode::kStop);
  CHECK(!bench.is_confirmed());
  // Stopped, but before this stop, or by another operator.
  bench.say(1, ArmActivity::kStopped, 0);
  CHECK(!bench.is_confirmed());
  bench.say(1, ArmActivity::kStopped, kOther);
  CHECK(!bench.is_confirmed());
  // It heard the stop, but continues.
  bench.say(1, ArmActivity::kMoving, kOperator);
  CHECK(!bench.is_confirmed());
  bench.say(1, ArmActivity::kStopped, kOperator);
  CHECK(bench.is_confirmed());
  bench.say(1, ArmActivity::kFault, kOperator);
  CHECK(bench.is_confirmed());
}

TEST_CASE("A second arm that did not stop delays the confirmation, an arm in a log does not") {
  Bench bench(CommandMode::kStop);
  bench.say(1, ArmActivity::kStopped, kOperator);
  bench.say(3, ArmActivity::kMoving, kOther, kSameClock, 300'000);
  CHECK(bench.is_confirmed());
  bench.say(2, ArmActivity::kMoving, kOther);
  CHECK(!bench.is_confirmed());
  CHECK(bench.arms.why_not(bench.now) == "the arm of session 2 says: that it moves");
}

TEST_CASE("An arm with an unknown clock delays the confirmation until it answers or falls silent") {
  for (const SenderClock& clock : {SenderClock{}, SenderClock{ClockOffset{0, 200'001}}}) {
    Bench bench(CommandMode::kStop);
    bench.say(1, ArmActivity::kStopped, kOperator);
    bench.say(2, ArmActivity::kMoving, kOther, clock);
    CHECK(!bench.is_confirmed());
    CHECK(bench.arms.why_not(bench.now) ==
          "the arm of session 2, whose clock is not known, says: that it moves");
    bench.say(2, ArmActivity::kStopped, kOperator, clock);
    CHECK(bench.is_confirmed());
    bench.say(2, ArmActivity::kMoving, kOther, clock);
    bench.now.monotonic_us += 250'001;
    bench.say(1, ArmActivity::kStopped, kOperator);
    CHECK(bench.is_confirmed());
  }
}

TEST_CASE("Messages of an arm from before its silence confirm nothing") {
  Bench bench(CommandMode::kStop);
  bench.say(1, ArmActivity::kStopped, kOperator);
  bench.now.monotonic_us += 250'001;
  CHECK(!bench.is_confirmed());
}

TEST_CASE("A reset answers each live arm, and is confirmed when no arm is latched") {
  Bench bench(CommandMode::kReset);
  bench.say(1, ArmActivity::kHolding, 0, std::nullopt);
  CHECK(!bench.is_confirmed());
  CHECK(bench.arms.sessions(bench.now).empty());
  bench.say(2, ArmActivity::kFault, 0);
  bench.say(3, ArmActivity::kStopped, kOther);
  CHECK(bench.arms.sessions(bench.now) == std::vector<std::int64_t>{2, 3});
  bench.say(2, ArmActivity::kHolding, 0);
  CHECK(!bench.is_confirmed());
  bench.say(3, ArmActivity::kIdle, 0);
  CHECK(bench.is_confirmed());
  bench.say(4, ArmActivity::kFault, 0, std::nullopt);
  CHECK(!bench.is_confirmed());
  CHECK(bench.arms.sessions(bench.now) == std::vector<std::int64_t>{2, 3});
}

}  // namespace
}  // namespace puck
