#pragma once

#include <cstdint>

#include "common/vision/pixel.h"

namespace puck {

/// A way along which one search after another has found something.
struct SightingTrail {
  int sightings = 0;  ///< 0: none.
  /// How far it has come within the last 0.3 s or so against what stands still, while it was known
  /// how that moves.
  double own_px = 0;
  double score = 0;          ///< SearchCandidate::score of the last ten or so, on average.
  double rms_px = 0;         ///< How far those were from where they were expected.
  PixelVelocity velocity;    ///< In the image.
  std::int64_t seen_us = 0;  ///< When it was last found.

  /// After so long it is at its end.
  static constexpr std::int64_t kEndsAfter_us = 25'000;

  /// It is not there by chance.
  constexpr bool is_likely() const {
    return sightings >= 4 && own_px >= 3 && score >= 0.3 && rms_px <= 1.3;
  }
  /// It goes its way too steadily for most clutter.
  constexpr bool is_steady() const {
    return sightings >= 6 && own_px >= 8 && score >= 0.4 && rms_px <= 0.9;
  }
  /// … and for so long that hardly anything but the puck does, whether it makes events or not.
  constexpr bool is_certain() const {
    return sightings >= 12 && own_px >= 15 && score >= 0.5 && rms_px <= 0.8;
  }
};

}  // namespace puck
