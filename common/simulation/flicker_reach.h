#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace puck {

/// Flicker levels at which each settled pixel fires its next event, so that only the pixels that
/// fire are visited.
class FlickerReach {
 public:
  /// Adds a pixel, which fires when the flicker's response is at least `up` or at most `down`.
  void add(float up, float down) {
    up_.push_back(up);
    down_.push_back(down);
  }
  void set(std::size_t pixel, float up, float down) {
    up_[pixel] = up;
    down_[pixel] = down;
  }

  /// Calls `visit` with each pixel that fires while the flicker goes from `lowest` to `highest`.
  template <typename Visit>
  void visit_reached(float lowest, float highest, Visit visit) const {
    // Nearly all pixels are out of reach, so blocks of them are rejected together.
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
