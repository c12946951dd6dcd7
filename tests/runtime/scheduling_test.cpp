#include "common/runtime/scheduling.h"

#include <array>
#include <cstdint>
#include <optional>
#include <thread>

#include <doctest/doctest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace puck {
namespace {

// The third 64-bit number of struct sched_attr, after two 32-bit ones and the flags. Nothing where
// the kernel does not give it.
std::optional<std::uint64_t> turn_ns() {
  std::array<std::uint64_t, 6> attributes{};
  if (syscall(SYS_sched_getattr, 0, attributes.data(), sizeof attributes, 0U) != 0) return {};
  return attributes[3];
}

int nice_value() { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())); }

}  // namespace

TEST_CASE("a thread with short time slices, and threads that it starts, keep their priority") {
  std::thread([] {
    CHECK(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 5) == 0);
    const auto before_ns = turn_ns();
    take_short_turns();
    // 0: a kernel without time slices.
    const auto expected = before_ns.value_or(0) == 0 ? before_ns : 100'000;
    CHECK(turn_ns() == expected);
    std::thread([&] { CHECK(turn_ns() == expected); }).join();
    CHECK(sched_getscheduler(0) == SCHED_OTHER);
    CHECK(nice_value() == 5);
  }).join();
}

TEST_CASE("a background thread has usual time slices, whatever its parent has") {
  std::thread([] {
    const auto usual_ns = turn_ns();
    take_short_turns();
    std::thread([&] {
      take_turns_behind_others();
      if (!usual_ns) return;  // The kernel refuses.
      CHECK(turn_ns() == usual_ns);
      CHECK(sched_getscheduler(0) == SCHED_BATCH);
      CHECK(nice_value() == 10);
    }).join();
  }).join();
}

TEST_CASE("a background thread has no more weight than before") {
  std::thread([] {
    CHECK(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 15) == 0);
    take_turns_behind_others();
    CHECK(nice_value() == 15);
  }).join();
}

}  // namespace puck
