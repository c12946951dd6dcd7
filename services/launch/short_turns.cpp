#include "services/launch/short_turns.h"

#include <cstdint>

#include <sys/syscall.h>
#include <unistd.h>

namespace puck {
namespace {

// The kernel's struct sched_attr, as it was at first; its header cannot be included beside libc's.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = 0;  // SCHED_OTHER
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t turn_ns = 0;
  std::uint64_t deadline_ns = 0;
  std::uint64_t period_ns = 0;
};

constexpr std::uint64_t kShortestTurnNs = 100'000;

}  // namespace

void take_short_turns() {
  SchedulingAttributes attributes;
  if (syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0U) != 0) return;
  attributes.turn_ns = kShortestTurnNs;
  syscall(SYS_sched_setattr, 0, &attributes, 0U);
}

}  // namespace puck
