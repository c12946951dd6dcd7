#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/vision/camera_turn.h"
#include "common/vision/pixel.h"

namespace puck {

/// How a camera has turned of late, from which follows how fast the image of what stands still
/// moves, under a shaking head as well. One thread at a time.
class TurnTrail {
 public:
  /// How the camera is turned at `time_us`, later than at the last call.
  void note(const CameraTurn& turn, std::int64_t time_us);
  /// Forgets all notes.
  void clear() { count_ = 0; }

  /// Velocity of what stands still and is at `place` as of the last note, px/s; none before kNotes
  /// notes.
  std::optional<PixelVelocity> still_velocity_at(Pixel place) const;

 private:
  struct Note {
    CameraTurn turn{{}, 1};
    std::int64_t time_us = 0;
  };
  // At one a millisecond: over fewer the alignment's noise shows, over more a shake is missed.
  static constexpr std::size_t kNotes = 12;

  std::array<Note, kNotes> notes_;  // a ring
  std::size_t count_ = 0;
};

}  // namespace puck
