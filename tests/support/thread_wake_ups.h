#pragma once

#include <sys/resource.h>

namespace puck {

/// How often the calling thread has given up the processor to wait, since its start.
inline long thread_wake_ups() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}

/// Counts the messages that a thread takes and how often it has waited meanwhile. `add` is called
/// on that thread, with each message.
struct WakeUpTally {
  long first = -1;
  long last = -1;
  int messages = 0;

  void add() {
    last = thread_wake_ups();
    if (first < 0) first = last;
    ++messages;
  }
  long wake_ups() const { return last - first; }
};

}  // namespace puck
