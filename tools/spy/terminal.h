#pragma once

#include <optional>

#include "tools/spy/screen.h"

namespace puck {

/// The terminal, taken over as long as this lives and given back as it was, however the program
/// leaves the block. The only place that knows ncurses. One at a time, one thread.
class Terminal {
 public:
  /// Throws std::runtime_error when stdin or stdout is no terminal, or one of an unknown type.
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  ScreenSize size() const;
  void show(const Screen& screen);
  /// The next key that was pressed and means something; nothing when there is none. Never waits.
  std::optional<SpyKey> read_key();
  /// Whether the size has changed since this was last asked.
  bool was_resized();

 private:
  bool resized_ = false;
};

}  // namespace puck
