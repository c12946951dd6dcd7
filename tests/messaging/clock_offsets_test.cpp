#include "common/messaging/clock_offsets.h"

#include <cstdlib>
#include <limits>
#include <optional>
#include <random>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kHour = 3600 * kSecond;

/// Simulated clocks of our host and of others.
class ClockBench {
 public:
  /// One ping and its answer; `there_us` and `back_us` are the delays of the two ways.
  bool exchange(std::int64_t session, std::int64_t ahead_us, std::int64_t there_us,
                std::int64_t back_us) {
    offsets.ping(now);
    ClockAnswer answer;
    answer.ping_utime = now.utime;
    pass(there_us);
    answer.received_utime = now.utime + ahead_us;
    pass(kWait_us);
    answer.answered_utime = now.utime + ahead_us;
    pass(back_us);
    answer.heard_monotonic_us = now.monotonic_us;
    return offsets.add(session, answer);
  }
  void pass(std::int64_t us) {
    now.utime += us;
    now.monotonic_us += us;
  }
  ClockOffset clock(std::int64_t session) const {
    const SenderClock clock = offsets.offset_of(session, now);
    REQUIRE(clock);
    return *clock;
  }

  static constexpr std::int64_t kWait_us = 70'000;
  HostNow now{1'700'000'000 * kSecond, 500 * kSecond};
  ClockOffsets offsets;
};

}  // namespace

TEST_CASE("the offset of a clock hours away is known after one answer, to half the round trip") {
  for (const std::int64_t ahead_us : {5 * kHour, -11 * kHour, std::int64_t{500}}) {
    CAPTURE(ahead_us);
    ClockBench bench;
    CHECK_FALSE(bench.offsets.offset_of(7, bench.now));
    // The way there takes 400 µs, the way back nothing: the largest error.
    REQUIRE(bench.exchange(7, ahead_us, 400, 0));
    const ClockOffset clock = bench.clock(7);
    CHECK(clock.ahead_us == ahead_us + 200);
    CHECK(clock.uncertainty_us >= 200);
    CHECK(clock.uncertainty_us <= 202);
    CHECK(std::abs(clock.to_own(bench.now.utime + ahead_us) - bench.now.utime) <=
          clock.uncertainty_us);
  }
}

TEST_CASE("a clock indistinguishable from ours is treated as ours, to the microsecond") {
  for (const std::int64_t ahead_us : {std::int64_t{0}, std::int64_t{90}, std::int64_t{-90}}) {
    CAPTURE(ahead_us);
    ClockBench bench;
    REQUIRE(bench.exchange(7, ahead_us, 150, 50));
    CHECK(bench.clock(7).ahead_us == (ahead_us == 90 ? 140 : 0));
    CHECK(std::abs(bench.clock(7).ahead_us - ahead_us) <= bench.clock(7).uncertainty_us);
  }
}

TEST_CASE("a clock treated as ours has the measurement's uncertainty as its bound") {
  // Measured 140 ms ahead, give or take 150 ms; in truth it is 280 ms ahead.
  ClockBench bench;
  REQUIRE(bench.exchange(7, 280'000, 10'000, 290'000));
  const ClockOffset clock = bench.clock(7);
  CHECK(clock.ahead_us == 0);
  CHECK(clock.uncertainty_us >= 280'000);
  // 240 ms old: not certainly younger than 200 ms.
  const std::int64_t sent_utime = bench.now.utime + 280'000 - 240'000;
  CHECK(freshness_of(sent_utime, bench.now, clock, 200'000) == Freshness::kClockUnknown);
}

TEST_CASE(
    "on a busy network the exchange with the shortest round trip counts, and its bound holds") {
  std::mt19937 random(3);
  std::exponential_distribution<double> delay(1.0 / 3000);
  ClockBench bench;
  for (int i = 0; i < 200; ++i) {
    const auto there_us = static_cast<std::int64_t>(100 + delay(random));
    const auto back_us = static_cast<std::int64_t>(100 + delay(random));
    REQUIRE(bench.exchange(7, kHour, there_us, back_us));
    const ClockOffset clock = bench.clock(7);
    CHECK(std::abs(clock.ahead_us - kHour) <= clock.uncertainty_us);
    if (i >= 31) CHECK(clock.uncertainty_us < 2500);
  }
}

TEST_CASE("a step of our own clock changes the offset at once and by the same amount") {
  ClockBench bench;
  REQUIRE(bench.exchange(7, kHour, 100, 100));
  bench.now.utime += 2 * kHour;
  CHECK(bench.clock(7).ahead_us == -kHour);
  // Also one in the middle of an exchange.
  bench.offsets.ping(bench.now);
  ClockAnswer answer{bench.now.utime, bench.now.utime - kHour, bench.now.utime - kHour, 0};
  bench.now.utime -= 2 * kHour;
  bench.pass(50);
  answer.heard_monotonic_us = bench.now.monotonic_us;
  CHECK(bench.offsets.add(7, answer));
  CHECK(std::abs(bench.clock(7).ahead_us - kHour) < 1000);
}

TEST_CASE("a step of another clock is accepted after two consecutive answers") {
  ClockBench bench;
  for (int i = 0; i < 50; ++i) REQUIRE(bench.exchange(7, kHour, 100, 100));
  bench.exchange(7, -kHour, 100, 100);
  CHECK(bench.clock(7).ahead_us == kHour);
  bench.exchange(7, -kHour, 100, 100);
  CHECK(bench.clock(7).ahead_us == -kHour);

  SUBCASE("a single wrong answer changes nothing, even repeatedly between right ones") {
    for (int i = 0; i < 20; ++i) {
      bench.exchange(7, 9 * kHour, 100, 100);
      bench.exchange(7, -kHour, 100, 100);
      CHECK(bench.clock(7).ahead_us == -kHour);
    }
  }
}

TEST_CASE("a drifting clock is followed, and the bound holds all the time") {
  ClockBench bench;
  for (int i = 0; i < 600; ++i) {
    bench.pass(30'000);
    const std::int64_t drifted_us = (bench.now.monotonic_us - 500 * kSecond) / 20'000;  // 50 ppm
    REQUIRE(bench.exchange(7, kHour + drifted_us, i % 10 == 0 ? 100 : 3000, 100));
    const ClockOffset clock = bench.clock(7);
    CHECK(std::abs(clock.ahead_us - kHour - drifted_us) <= clock.uncertainty_us + 10);
    CHECK(clock.uncertainty_us < 1000);
  }
}

TEST_CASE("without answers an offset's bound grows") {
  ClockBench bench;
  REQUIRE(bench.exchange(7, kHour, 100, 100));
  bench.pass(kHour);
  CHECK(bench.clock(7).uncertainty_us > 300'000);
  CHECK(freshness_of(bench.now.utime + kHour, bench.now, bench.clock(7), 200'000) ==
        Freshness::kClockUnknown);
}

TEST_CASE("a restarted run is unknown until it answers") {
  ClockBench bench;
  REQUIRE(bench.exchange(7, kHour, 100, 100));
  CHECK_FALSE(bench.offsets.offset_of(8, bench.now));
  REQUIRE(bench.exchange(8, 2 * kHour, 100, 100));
  CHECK(bench.clock(7).ahead_us == kHour);
  CHECK(bench.clock(8).ahead_us == 2 * kHour);
}

TEST_CASE("answers to unknown or old questions, and contradictory ones, are refused") {
  ClockBench bench;
  bench.offsets.ping(bench.now);
  const HostNow sent = bench.now;
  bench.pass(100'000);
  const ClockAnswer good{sent.utime, sent.utime, sent.utime + 50'000, bench.now.monotonic_us};
  const auto refused = [&](auto spoil) {
    ClockAnswer answer = good;
    spoil(answer);
    return !bench.offsets.add(7, answer);
  };
  CHECK(refused([](ClockAnswer& a) { a.ping_utime += 1; }));
  CHECK(refused([](ClockAnswer& a) { a.ping_utime = 0; }));
  // It waited there for longer than the round trip took.
  CHECK(refused([](ClockAnswer& a) { a.answered_utime += 60'000; }));
  CHECK(refused([](ClockAnswer& a) { a.answered_utime -= 60'000; }));
  CHECK(refused([](ClockAnswer& a) { a.received_utime = -1; }));
  CHECK(refused([](ClockAnswer& a) { a.received_utime = std::int64_t{1} << 62; }));
  CHECK(refused([](ClockAnswer& a) { a.answered_utime = std::int64_t{1} << 62; }));
  CHECK(refused([&](ClockAnswer& a) { a.heard_monotonic_us = sent.monotonic_us - 1; }));
  CHECK(bench.offsets.sessions() == 0);

  for (int i = 0; i < 31; ++i) {
    bench.pass(100'000);
    bench.offsets.ping(bench.now);
  }
  CHECK(bench.offsets.add(7, good));
  bench.offsets.ping(bench.now);
  CHECK(refused([](ClockAnswer&) {}));
}

TEST_CASE("delayed answers widen the bound instead of changing the offset") {
  ClockBench bench;
  for (int i = 0; i < 100; ++i) REQUIRE(bench.exchange(7, kHour, 100, kSecond));
  const ClockOffset clock = bench.clock(7);
  CHECK(std::abs(clock.ahead_us - kHour) <= clock.uncertainty_us);
  CHECK(freshness_of(bench.now.utime + kHour, bench.now, clock, 200'000) ==
        Freshness::kClockUnknown);
}

TEST_CASE("a flood of runs takes at most 64 places, and the latest ones keep theirs") {
  ClockBench bench;
  REQUIRE(bench.exchange(7, kHour, 100, 100));
  for (std::int64_t session = 1000; session < 21'000; ++session) {
    REQUIRE(bench.exchange(session, 0, 100, 100));
    if (session % 50 == 0) REQUIRE(bench.exchange(7, kHour, 100, 100));
  }
  CHECK(bench.offsets.sessions() == ClockOffsets::kSessions);
  CHECK(bench.clock(7).ahead_us == kHour);
  CHECK(bench.offsets.offset_of(20'999, bench.now));
  CHECK_FALSE(bench.offsets.offset_of(1000, bench.now));
}

TEST_CASE("a message is live, old or from the future by its sender's clock, for any utime") {
  const HostNow now{1'700'000'000 * kSecond, 1};
  const ClockOffset clock{5 * kHour, 1'000};
  const std::int64_t there = now.utime + 5 * kHour;
  const auto judged = [&](std::int64_t utime) { return freshness_of(utime, now, clock, 200'000); };
  CHECK(judged(there) == Freshness::kOfNow);
  // The uncertainty counts against the sender.
  CHECK(judged(there - 199'000) == Freshness::kOfNow);
  CHECK(judged(there - 199'001) == Freshness::kOld);
  CHECK(judged(there + 199'000) == Freshness::kOfNow);
  CHECK(judged(there + 199'001) == Freshness::kFromFuture);
  CHECK(judged(now.utime) == Freshness::kOld);
  CHECK(judged(std::numeric_limits<std::int64_t>::min()) == Freshness::kOld);
  CHECK(judged(std::numeric_limits<std::int64_t>::max()) == Freshness::kFromFuture);
  CHECK(freshness_of(there, now, std::nullopt, 200'000) == Freshness::kClockUnknown);
  CHECK(freshness_of(there, now, ClockOffset{5 * kHour, 200'001}, 200'000) ==
        Freshness::kClockUnknown);
}

}  // namespace puck
