#pragma once

#include <csignal>

namespace puck {

/// Whether the program has been asked to end: by Ctrl-C, by SIGTERM, or by a terminal that went
/// away. Make it before any thread: a signal that a thread lets through still kills.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// Never waits.
  bool requested();

 private:
  sigset_t signals_{};
  sigset_t old_mask_{};
  bool requested_ = false;
};

}  // namespace puck
