#pragma once

#include <array>
#include <cstddef>

namespace puck {

/// Knows the pixels of the last few events somewhere: one that fires again while hardly any other
/// does is a hot one, and no sign that anything moves there.
class RecentPixels {
 public:
  /// Takes an event; true when one of the last few was its pixel's.
  bool repeats(int x, int y) {
    for (const Place& place : places_) {
      if (place.x == x && place.y == y) return true;
    }
    places_[next_] = {x, y};
    next_ = (next_ + 1) % places_.size();
    return false;
  }

 private:
  struct Place {
    int x = -1;  // no pixel
    int y = -1;
  };
  std::array<Place, 4> places_{};
  std::size_t next_ = 0;
};

}  // namespace puck
