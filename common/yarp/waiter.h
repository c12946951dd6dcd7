#pragma once

#include <chrono>
#include <span>
#include <stop_token>

#include <poll.h>

#include "common/posix/file_descriptor.h"

namespace puck {

using SteadyClock = std::chrono::steady_clock;  // CLOCK_MONOTONIC
using Deadline = SteadyClock::time_point;

inline Deadline in_ms(int ms) { return SteadyClock::now() + std::chrono::milliseconds(ms); }

/// Ends a wait of another thread.
class Waker {
 public:
  Waker();
  Waker(const Waker&) = delete;
  Waker& operator=(const Waker&) = delete;

  /// Safe from any thread.
  void wake();

 private:
  friend class Waiter;
  FileDescriptor calls_;
};

/// Waits for sockets until a deadline, a waker's call or a stop. One thread.
class Waiter {
 public:
  /// A stop must also call the waker.
  Waiter(std::stop_token stop, Waker& waker) : stop_(std::move(stop)), waker_(waker) {}

  bool is_stopped() const { return stop_.stop_requested(); }

  /// Waits until a socket is ready, the deadline has come, or the waker was called.
  void wait(std::span<const pollfd> sockets, Deadline deadline) const;

  /// Waits until the socket is ready for `events`; false: the deadline has come. Throws YarpError
  /// on a stop.
  bool wait_for(int socket, short events, Deadline deadline) const;

  /// Throws YarpError on a stop.
  void rest_until(Deadline deadline) const { wait_for(-1, 0, deadline); }

 private:
  std::stop_token stop_;
  Waker& waker_;
};

}  // namespace puck
