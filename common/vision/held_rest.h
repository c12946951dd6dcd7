#pragma once

#include <cstdint>

#include "common/vision/track_looks.h"

namespace puck {

/// A puck at rest stays where it is while a mallet or a hand comes near: what happens beside it
/// says nothing about it. It is let go by what only its own contour or something on it can do:
/// events all around the contour, or inside it; or when it has been disturbed for long.
class HeldRest {
 public:
  /// To be called at each decision; `is_resting`: the puck is surely the one that rests here.
  void judge(const TrackLooks& main, bool is_resting, std::int64_t time_us);

  /// Whether the main track must not move, nor be led away.
  bool is_held() const { return is_held_; }
  /// Whether it was let go at the last decision because the puck departs.
  bool departs() const { return departs_; }
  /// The main track is another one.
  void forget() { is_held_ = departs_ = false; }

 private:
  bool is_held_ = false;
  bool departs_ = false;
  std::int64_t quiet_us_ = 0;  // when it last rested undisturbed
};

}  // namespace puck
