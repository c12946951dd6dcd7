#pragma once

#include <csignal>

namespace puck {

/// Whether the program was asked to stop: by Ctrl-C, SIGTERM, or a lost terminal. Construct it
/// before any thread: a signal that another thread does not block still kills.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// Never blocks.
  bool requested();

 private:
  sigset_t signals_{};
  sigset_t old_mask_{};
  bool requested_ = false;
};

}  // namespace puck
