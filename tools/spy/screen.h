#pragma once

#include <string>
#include <vector>

namespace puck {

struct ScreenSize {
  int columns = 80;
  int rows = 24;
};

enum class LineStyle { kPlain, kTitle, kHead, kWarning, kAlarm, kFaint };

struct ScreenLine {
  std::string text;
  LineStyle style = LineStyle::kPlain;
  bool selected = false;
};

/// From the top; at most as many rows and columns as the screen.
using Screen = std::vector<ScreenLine>;

/// Commands of the keyboard.
enum class SpyKey {
  kUp,
  kDown,
  kPageUp,
  kPageDown,
  kFirst,
  kLast,
  kShow,
  kBack,
  kSort,
  kReverse,
  kPause,
  kOthers,
  kHelp,
  kQuit,
};

}  // namespace puck
