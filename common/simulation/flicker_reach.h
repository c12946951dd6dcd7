#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace puck {

/// How far the flicker must take each settled pixel's response for its next event, so that only
/// those that it does are looked at.
class FlickerReach {
 public:
  /// One more pixel, or one that has settled anew; fires when the flicker's response is at least
  /// `up` or at most `down`.
  void add(float up, float down) {
    up_.push_back(up);
    down_.push_back(down);
  }
  void set(std::size_t pixel, float up, float down) {
    up_[pixel] = up;
    down_[pixel] = down;
  }

  /// Calls `visit` with each pixel that fires between these.
  template <typename Visit>
  void visit_reached(float lowest, float highest, Visit visit) const {
    // Nearly all are out of reach, which is told many at a time.
    constexpr std::size_t kTogether = 64;
    const auto is_reached = [&](std::size_t i) {
      return static_cast<int>(up_[i] <= highest) | static_cast<int>(down_[i] >= lowest);
    };
    for (std::size_t first = 0; first < up_.size(); first += kTogether) {
      const std::size_t end = std::min(up_.size(), first + kTogether);
      int reached = 0;
      for (std::size_t i = first; i < end; ++i) reached += is_reached(i);
      if (reached == 0) continue;
      for (std::size_t i = first; i < end; ++i) {
        if (is_reached(i) != 0) visit(i);
      }
    }
  }

 private:
  std::vector<float> up_;
  std::vector<float> down_;
};

}  // namespace puck
