#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace puck {

/// Turns SIGINT and SIGTERM into a stop request. Make it first: threads created before can still be
/// killed by the signals.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  void wait_for_signal();

  std::stop_source source_;
  sigset_t signals_{};
  sigset_t old_mask_{};
  std::jthread thread_;
};

}  // namespace puck
