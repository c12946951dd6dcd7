#include "tools/spy/stop_signal.h"

#include <array>
#include <ctime>

#include <pthread.h>

namespace puck {

StopSignal::StopSignal() {
  sigemptyset(&signals_);
  for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
  pthread_sigmask(SIG_BLOCK, &signals_, &old_mask_);
}

StopSignal::~StopSignal() {
  requested();  // A pending signal would kill the process once unblocked.
  pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr);
}

bool StopSignal::requested() {
  const timespec at_once{};
  while (sigtimedwait(&signals_, nullptr, &at_once) > 0) requested_ = true;
  return requested_;
}

}  // namespace puck
