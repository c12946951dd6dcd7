#pragma once

#include <cstdint>
#include <string>

namespace puck {

/// A wish of the viewer that changes what is played. Values are checked by the source.
struct ViewControl {
  enum class Action : std::uint8_t {
    kPlay,  ///< From the start, if it has ended.
    kPause,
    kStep,          ///< Pauses and advances by `value` s; negative: goes back.
    kSeek,          ///< To `value` s after the first event.
    kSpeed,         ///< `value` times the recording's pace; 0: as fast as possible.
    kTracker,       ///< Side `side` shows `name`.
    kNextLoss,      ///< Pauses at the next loss of side `side`.
    kPreviousLoss,  ///< Pauses at the previous one.
  };

  Action action = Action::kPause;
  double value = 0;
  int side = 0;
  std::string name;
};

}  // namespace puck
