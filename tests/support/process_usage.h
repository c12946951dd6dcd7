#pragma once

#include <cstdint>

#include <sys/types.h>

namespace puck {

/// Resources that a process has used since its start.
struct ProcessUsage {
  double cpu_s = 0;           ///< User and system time of all its threads.
  std::int64_t wake_ups = 0;  ///< Voluntary context switches of its threads.
};

/// Resident memory now, MB. Throws std::runtime_error without such a process.
double resident_mb(pid_t pid);

/// From /proc. Throws std::runtime_error without such a process.
ProcessUsage usage_of(pid_t pid);

}  // namespace puck
