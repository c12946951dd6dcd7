#include "common/runtime/scheduling.h"

#include <algorithm>
#include <cstdint>

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace puck {
namespace {

// The kernel's struct sched_attr, as it was at first; its header cannot be included beside libc's.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = 0;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t turn_ns = 0;  // 0: as long as the kernel finds right
  std::uint64_t deadline_ns = 0;
  std::uint64_t period_ns = 0;
};

constexpr std::uint64_t kShortestTurnNs = 100'000;
constexpr std::int32_t kNice = 10;

// Of the calling thread. What has a policy of the real-time kind was given it on purpose.
template <typename Change>
void change_attributes(const Change& change) {
  SchedulingAttributes attributes;
  if (syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0U) != 0) return;
  if (attributes.policy != SCHED_OTHER && attributes.policy != SCHED_BATCH) return;
  change(attributes);
  syscall(SYS_sched_setattr, 0, &attributes, 0U);
}

}  // namespace

void take_short_turns() {
  change_attributes([](SchedulingAttributes& its) { its.turn_ns = kShortestTurnNs; });
}

void take_turns_behind_others() {
  change_attributes([](SchedulingAttributes& its) {
    its.policy = SCHED_BATCH;
    its.nice = std::max(its.nice, kNice);  // To ask for more than it has could be refused.
    its.turn_ns = 0;
  });
}

}  // namespace puck
