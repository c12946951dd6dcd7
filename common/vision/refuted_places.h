#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "common/vision/pixel.h"

namespace puck {

/// Places where what the search found turned out not to be the puck, for a short while: they look
/// like one, so that the search finds them again and again, and others would never be tried. What
/// looks clearly more like one than what was refuted there is tried again: a puck that comes out
/// from under a hand is where the hand's edge was.
class RefutedPlaces {
 public:
  /// `score`: SearchCandidate::score.
  void add(Pixel position, double score, std::int64_t time_us) {
    places_[next_] = {position, score, time_us};
    next_ = (next_ + 1) % places_.size();
  }

  bool contains(Pixel position, double score, std::int64_t time_us) const {
    for (const Place& place : places_) {
      if (time_us - place.time_us < kMemory_us && score < place.score + kClearly &&
          std::abs(place.position.x - position.x) < kNear_px &&
          std::abs(place.position.y - position.y) < kNear_px) {
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::int64_t kMemory_us = 100'000;
  static constexpr double kNear_px = 6;
  static constexpr double kClearly = 0.1;

  struct Place {
    Pixel position;
    double score = 0;
    std::int64_t time_us = std::numeric_limits<std::int64_t>::min() / 2;
  };
  std::array<Place, 32> places_{};
  std::size_t next_ = 0;
};

}  // namespace puck
