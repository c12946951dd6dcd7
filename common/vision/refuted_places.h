#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "common/vision/pixel.h"

namespace puck {

/// Places where what the search found turned out not to be the puck, for a short while: they look
/// like one, so that the search finds them again and again, and others would never be tried.
class RefutedPlaces {
 public:
  void add(Pixel position, std::int64_t time_us) {
    places_[next_] = {position, time_us};
    next_ = (next_ + 1) % places_.size();
  }

  bool contains(Pixel position, std::int64_t time_us) const {
    for (const Place& place : places_) {
      if (time_us - place.time_us < kMemory_us &&
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

  struct Place {
    Pixel position;
    std::int64_t time_us = std::numeric_limits<std::int64_t>::min() / 2;
  };
  std::array<Place, 32> places_{};
  std::size_t next_ = 0;
};

}  // namespace puck
