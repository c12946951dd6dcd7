#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include <sys/resource.h>

#include "common/messaging/bus.h"

namespace puck {

/// Voluntary context switches of the calling thread since its start.
inline long thread_wake_ups() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}

/// Counts a thread's messages and its waits meanwhile. Call `add` on that thread, with each
/// message.
struct WakeUpTally {
  long first = -1;
  long last = -1;
  std::atomic<int> messages = 0;  // Other threads may wait for them.

  void add() {
    last = thread_wake_ups();
    if (first < 0) first = last;
    ++messages;
  }
  long wake_ups() const { return last - first; }
};

/// Publishes a message `count` times, one every 100 µs by the clock, so that even a slow machine
/// sends many in a millisecond. Returns whether all were sent.
template <typename Message>
bool publish_ten_a_ms(Bus& bus, Message message, int count) {
  const auto begin = std::chrono::steady_clock::now();
  bool are_sent = true;
  for (int i = 1; i <= count; ++i) {
    are_sent = bus.publish(message) && are_sent;
    std::this_thread::sleep_until(begin + i * std::chrono::microseconds(100));
  }
  return are_sent;
}

}  // namespace puck
