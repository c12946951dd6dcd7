#include "services/launch/short_turns.h"

#include <array>
#include <cstdint>
#include <thread>

#include <doctest/doctest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace puck {
namespace {

// The third of the kernel's 64-bit numbers after two of 32 bits and flags: struct sched_attr.
std::uint64_t turn_ns() {
  std::array<std::uint64_t, 6> attributes{};
  REQUIRE(syscall(SYS_sched_getattr, 0, attributes.data(), sizeof attributes, 0U) == 0);
  return attributes[3];
}

}  // namespace

TEST_CASE("a thread that takes short turns, and those that it starts, keep their priority") {
  std::thread([] {
    REQUIRE(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 5) == 0);
    const std::uint64_t before_ns = turn_ns();
    take_short_turns();
    // Nothing: a kernel that knows no turns.
    if (before_ns != 0) {
      CHECK(before_ns > 100'000);
      CHECK(turn_ns() == 100'000);
    }
    std::thread([&] { CHECK(turn_ns() == (before_ns != 0 ? 100'000 : 0)); }).join();
    CHECK(sched_getscheduler(0) == SCHED_OTHER);
    CHECK(getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())) == 5);
  }).join();
}

}  // namespace puck
