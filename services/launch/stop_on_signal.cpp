#include "services/launch/stop_on_signal.h"

#include <ctime>

#include <pthread.h>

namespace puck {

StopOnSignal::StopOnSignal() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  // Threads created later inherit the mask, so that only this thread receives the signals.
  pthread_sigmask(SIG_BLOCK, &signals_, &old_mask_);
  thread_ = std::jthread([this] { wait_for_signal(); });
}

StopOnSignal::~StopOnSignal() {
  // Wakes the thread if it still waits.
  pthread_kill(thread_.native_handle(), SIGTERM);
  thread_.join();
  // Discards repeated signals, as of a second Ctrl-C.
  const timespec at_once{};
  while (sigtimedwait(&signals_, nullptr, &at_once) > 0) continue;
  pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr);
}

void StopOnSignal::wait_for_signal() {
  int signal = 0;
  sigwait(&signals_, &signal);
  source_.request_stop();
}

}  // namespace puck
