#include "services/tracker/catch_up.h"

#include <algorithm>
#include <cstdint>

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("packets with a short wait are all taken") {
  CatchUp catch_up;
  for (int i = 0; i < 1000; ++i) {
    CHECK_FALSE(catch_up.leaves_out(i * 1000, i * 1000 + CatchUp::kBehindUs));
  }
}

TEST_CASE("a short delay that is made up for costs no packet") {
  CatchUp catch_up;
  // 40 ms of packets are queued; each is processed in half of its duration.
  for (int i = 0; i < 70; ++i) {
    const std::int64_t received_us = i * 1000;
    CHECK_FALSE(catch_up.leaves_out(received_us, 40'000 + i * 500));
  }
}

TEST_CASE("a queue that does not shrink is dropped whole, down to the newest packet") {
  CatchUp catch_up;
  const std::int64_t began_us = 20'000;
  CHECK_FALSE(catch_up.leaves_out(0, began_us));
  CHECK_FALSE(catch_up.leaves_out(4'000, began_us + CatchUp::kPatienceUs));
  CHECK(catch_up.leaves_out(4'100, began_us + CatchUp::kPatienceUs + 1));
  CHECK(catch_up.leaves_out(60'000, began_us + CatchUp::kPatienceUs + 2));
  const std::int64_t now_us = began_us + CatchUp::kPatienceUs + 3;
  CHECK(catch_up.leaves_out(now_us - CatchUp::kBehindUs - 1, now_us));
  CHECK_FALSE(catch_up.leaves_out(now_us - CatchUp::kBehindUs, now_us));
  // Caught up: the time limit starts again.
  CHECK_FALSE(catch_up.leaves_out(now_us, now_us + 30'000));
}

TEST_CASE("in a flood of five times the capacity no packet waits for long") {
  CatchUp catch_up;
  constexpr std::int64_t kEveryUs = 100;
  constexpr std::int64_t kTakesUs = 500;
  constexpr std::int64_t kSkipTakesUs = 5;
  constexpr std::int64_t kPackets = 100'000;
  std::int64_t now_us = 0;
  std::int64_t taken = 0;
  std::int64_t longest_us = 0;
  for (std::int64_t i = 0; i < kPackets; ++i) {
    now_us = std::max(now_us, i * kEveryUs);
    longest_us = std::max(longest_us, now_us - i * kEveryUs);
    const bool leaves_out = catch_up.leaves_out(i * kEveryUs, now_us);
    if (!leaves_out) ++taken;
    now_us += leaves_out ? kSkipTakesUs : kTakesUs;
  }
  CHECK(longest_us < CatchUp::kPatienceUs + 10'000);
  // Meanwhile it works at its capacity.
  CHECK(taken * kTakesUs > kPackets * kEveryUs * 8 / 10);
}

}  // namespace puck
