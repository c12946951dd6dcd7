#pragma once

#include <optional>
#include <string>

#include <termios.h>

#include "services/camera/replay_request.h"

namespace puck {

/// Reads single keys from the terminal on stdin while this process is in its foreground, and
/// restores the terminal on destruction. Without a terminal there are no keys. One at a time, one
/// thread.
class TerminalKeys {
 public:
  static constexpr const char* kHelp =
      "keys: space pauses and plays on, . steps, left and right go 1 s, down and up 10 s back and "
      "on, + and - double and halve the speed, ? shows this";

  TerminalKeys();
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  /// Whether stdin is a terminal and in use.
  bool is_on() const { return is_on_; }

  /// The next request that was typed; nothing if there is none. Never blocks.
  std::optional<ReplayRequest> read();
  /// Whether the help was asked for since the last call.
  bool was_help_asked();

 private:
  bool take_over();
  bool is_in_foreground() const;
  bool read_typed();
  std::optional<ReplayRequest> next_request();

  termios before_{};
  bool is_on_ = false;
  bool was_help_asked_ = false;
  std::string typed_;  // Not handled yet; an arrow's sequence may come in parts.
};

}  // namespace puck
