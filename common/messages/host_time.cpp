#include "common/messages/host_time.h"

#include <ctime>

namespace puck {
namespace {

std::int64_t now_us(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000 + now.tv_nsec / 1000;
}

}  // namespace

std::int64_t host_utime() { return now_us(CLOCK_REALTIME); }

std::int64_t host_monotonic_us() { return now_us(CLOCK_MONOTONIC); }

}  // namespace puck
