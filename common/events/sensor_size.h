#pragma once

namespace puck {

/// Size of an event sensor in pixels. x runs right from 0 to width − 1, y down from 0 to height −
/// 1; pixel centres lie at integers.
struct SensorSize {
  /// Largest width and height that the project supports.
  static constexpr int kMax = 2048;

  int width = 0;
  int height = 0;

  friend constexpr bool operator==(SensorSize, SensorSize) = default;

  constexpr bool is_valid() const {
    return width >= 1 && width <= kMax && height >= 1 && height <= kMax;
  }
  constexpr bool contains(int x, int y) const {
    return x >= 0 && x < width && y >= 0 && y < height;
  }
};

}  // namespace puck
