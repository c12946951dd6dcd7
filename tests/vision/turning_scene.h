#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/vision/scene/background.h"

namespace puck::test {

/// What a camera that sways from side to side sees of a table full of round marks: as many events
/// of their edges a millisecond as there are places on them.
class TurningScene {
 public:
  static constexpr SensorSize kSensor{640, 480};
  /// Background's: as the tracker has it.
  static constexpr int kLeastCells = 24;

  /// How far the image has moved to the side, px.
  static double sway_px(std::int64_t time_us) {
    return 25 * std::sin(2 * std::numbers::pi * static_cast<double>(time_us) * 1e-6 / 2);
  }
  static constexpr int kMarks = 45;
  /// A place on the edge of one of the marks now.
  static Pixel place(int mark, double angle, std::int64_t time_us) {
    return {80.0 + 60 * (mark % 9) + 15 * std::cos(angle) + sway_px(time_us),
            60.0 + 90 * (mark / 9) + 15 * std::sin(angle)};
  }

  /// Shows the scene for so long, from where it was left.
  void show(Background& background, int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) {
      for (int mark = 0; mark < kMarks; ++mark) {
        for (int n = 0; n < 20; ++n) {
          state_ = state_ * 1664525u + 1013904223u;
          const double angle = 2 * std::numbers::pi * (state_ >> 8) / 0x1p24;
          const Pixel at = place(mark, angle, time_us_);
          background.take(std::round(at.x), std::round(at.y));
        }
      }
      time_us_ += 1'000;
      background.decide(time_us_);
    }
  }
  std::int64_t time_us() const { return time_us_; }
  /// Goes on at another time.
  void wait_until(std::int64_t time_us) { time_us_ = time_us; }

 private:
  std::int64_t time_us_ = 0;
  std::uint32_t state_ = 1;
};

/// Share of the marks' edges that a background takes to stand still.
inline double still_share_of_marks(const Background& background, std::int64_t time_us) {
  int still = 0;
  constexpr int kPlaces = 20;
  for (int mark = 0; mark < TurningScene::kMarks; ++mark) {
    for (int i = 0; i < kPlaces; ++i) {
      const Pixel at = TurningScene::place(mark, 2 * std::numbers::pi * i / kPlaces, time_us);
      if (background.is_still(at.x, at.y)) ++still;
    }
  }
  return still / (1.0 * TurningScene::kMarks * kPlaces);
}

}  // namespace puck::test
