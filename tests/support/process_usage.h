#pragma once

#include <cstdint>

#include <sys/types.h>

namespace puck {

/// What a process has used since its start.
struct ProcessUsage {
  double cpu_s = 0;           ///< Of all its threads, in and for them.
  std::int64_t wake_ups = 0;  ///< How often its threads gave up the processor to wait.
};

/// Memory that it has in use now, MB. Throws std::runtime_error when there is no such process.
double resident_mb(pid_t pid);

/// As /proc tells it. Throws std::runtime_error when there is no such process.
ProcessUsage usage_of(pid_t pid);

}  // namespace puck
