#pragma once

#include <optional>

#include "tools/spy/screen.h"

namespace puck {

/// Owns the terminal and restores it on destruction. The only user of ncurses. One at a time, one
/// thread.
class Terminal {
 public:
  /// Throws std::runtime_error if stdin or stdout is no terminal, or one of unknown type.
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  ScreenSize size() const;
  void show(const Screen& screen);
  /// The next known key; empty if none was pressed. Never blocks.
  std::optional<SpyKey> read_key();
  /// Whether the size has changed since the last call.
  bool was_resized();

 private:
  bool resized_ = false;
};

}  // namespace puck
