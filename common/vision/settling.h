#pragma once

#include <cstdint>

#include "common/vision/contour_track.h"

namespace puck {

/// A puck that comes to rest makes fewer and fewer events, until noise, or the hand that has caught
/// it, has as many and leads the track away. So the place where a slow puck was last seen clearly
/// is remembered; when its events die away soon after, it rests there.
class Settling {
 public:
  /// To be called after each decision of the main track; true when it has put it to rest.
  /// `was_covered`: TrackTrust's. Switched by ContourIngredients::settling.
  bool settle(ContourTrack& main, const ContourContext& context, bool was_covered,
              std::int64_t time_us);

  /// The main track is another one: where the last one was clear says nothing about it.
  void forget() { was_slow_ = false; }

 private:
  Pixel place_;
  bool was_slow_ = false;  // when it was last seen clearly
  std::int64_t clear_us_ = 0;
};

}  // namespace puck
