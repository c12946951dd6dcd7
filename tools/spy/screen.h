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

/// From the top; as many as the screen has rows, each as long as it has columns at most.
using Screen = std::vector<ScreenLine>;

/// What can be asked for with the keyboard.
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
