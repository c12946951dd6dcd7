#include "tools/view/recording/play_clock.h"

#include <chrono>

#include <doctest/doctest.h>

namespace puck {
namespace {

using std::chrono::milliseconds;

const PlayClock::Clock::time_point kStart{std::chrono::hours(1)};

TEST_CASE("a tenth of the speed plays a tenth of the time") {
  PlayClock clock;
  clock.set_speed(0.1);
  clock.start({5'000'000}, kStart);
  CHECK(clock.due({5'000'000}, kStart + milliseconds(50)) == Timestamp{5'005'000});
}

TEST_CASE("a recording that falls behind goes on from where it is, and says its speed") {
  PlayClock clock;
  clock.start({0}, kStart);
  Timestamp reached{0};
  for (int ms = 10; ms <= 2000; ms += 10) {
    const Timestamp due = clock.due(reached, kStart + milliseconds(ms));
    CHECK(due - reached <= 100'000);
    reached = reached + 4'000;  // 0.4 of the time
  }
  CHECK(clock.is_too_slow());
  CHECK(clock.reached_speed() == doctest::Approx(0.4).epsilon(0.02));
}

TEST_CASE("as fast as possible is always due and never too slow") {
  PlayClock clock;
  clock.set_speed(0);
  clock.start({0}, kStart);
  CHECK(clock.due({0}, kStart) > Timestamp{0});
  clock.due({10'000}, kStart + milliseconds(1000));
  CHECK(!clock.is_too_slow());
}

}  // namespace
}  // namespace puck
