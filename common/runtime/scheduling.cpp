#include "common/runtime/scheduling.h"

#include <algorithm>
#include <cstdint>

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace puck {
namespace {

// The first version of the kernel's struct sched_attr; the kernel's header conflicts with libc's.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = 0;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t slice_ns = 0;  // 0: the kernel's default.
  std::uint64_t deadline_ns = 0;
  std::uint64_t period_ns = 0;
};

constexpr std::uint64_t kShortestSliceNs = 100'000;
constexpr std::int32_t kNice = 10;

// Of the calling thread. A real-time policy is left alone: the user has set it.
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
  change_attributes(
      [](SchedulingAttributes& attributes) { attributes.slice_ns = kShortestSliceNs; });
}

void take_turns_behind_others() {
  change_attributes([](SchedulingAttributes& attributes) {
    attributes.policy = SCHED_BATCH;
    // Never lowered: that may need a permission.
    attributes.nice = std::max(attributes.nice, kNice);
    attributes.slice_ns = 0;
  });
}

}  // namespace puck
