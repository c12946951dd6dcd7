#include "services/launch/real_time.h"

#include <cerrno>
#include <cstring>

#include <sched.h>
#include <sys/mman.h>

namespace puck {

std::string run_in_real_time(int priority) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted) != 0) {
    return std::string("SCHED_FIFO: ") + std::strerror(errno);
  }
  // MCL_ONFAULT locks only used pages: little of an 8 MB stack is ever used.
  if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0) {
    return std::string(
               "runs under SCHED_FIFO, but its memory is not locked and may be paged "
               "out: ") +
           std::strerror(errno);
  }
  return {};
}

void run_in_real_time_and_tell(int priority, spdlog::logger& log) {
  if (priority == 0) return;
  const std::string why_not = run_in_real_time(priority);
  log.info(why_not.empty()
               ? "runs in real time"
               : "real-time scheduling is incomplete, so this service may be late on a busy "
                 "machine: " +
                     why_not);
}

}  // namespace puck
