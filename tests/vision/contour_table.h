#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"
#include "tests/vision/moving_contour.h"

namespace puck::test {

inline constexpr SensorSize kTableSensor{320, 240};
inline constexpr PuckSizeModel kTableSizeModel{16, 0, 0.08, 8, 0, 0.08};

/// Shows a tracker, with the parameters of preset `default` unless given others, a dark puck that
/// glides, rests, jumps or hides.
class ContourTable {
 public:
  explicit ContourTable(const HypothesesParams& params = default_params(), std::uint32_t seed = 1,
                        const PuckSizeModel& size_model = kTableSizeModel)
      : contour_(kTableSensor, size_model, exact()),
        tracker_(kTableSensor, with_exact(params), size_model),
        random_(seed) {}

  /// Lets the puck glide for so long; the mean error of the last half, px.
  double glide(PixelVelocity velocity, int milliseconds) {
    MovingContour puck(contour_, puck_, velocity, density, wall_share_);
    puck.has_print = has_print;
    double sum = 0;
    for (int i = 0; i < milliseconds; ++i) {
      const std::int64_t from_us = i * 1000;
      show(packet_of(puck.events(from_us, from_us + 1000), kTableSensor, now_us_, from_us));
      puck_ = puck.position_at(from_us + 1000);
      if (i >= milliseconds / 2) sum += error_px();
    }
    return sum / (milliseconds - milliseconds / 2);
  }

  /// Slows down until nothing is left but noise.
  void come_to_rest() {
    glide({250, 30}, 500);
    for (const double speed : {120, 80, 50, 30}) glide({speed, 0}, 40);
    rest(500, 3);
  }

  /// Nothing moves but a few pixels that fire at random, so many a millisecond.
  void rest(int milliseconds, int pixels = 1) {
    for (int i = 0; i < milliseconds; ++i) {
      EventPacket packet{{now_us_}, {}};
      for (int n = 0; n < pixels; ++n) packet.events.push_back(stray(500 + n));
      show(packet);
    }
  }

  /// Something covers the puck: events of both signs all over it.
  void cover(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) {
      EventPacket packet{{now_us_}, {}};
      for (int n = 0; n < 100; ++n) {
        random_ = random_ * 1664525u + 1013904223u;
        packet.events.push_back({static_cast<std::uint16_t>(puck_.x - 30 + (random_ >> 8) % 60),
                                 static_cast<std::uint16_t>(puck_.y - 30 + (random_ >> 20) % 60),
                                 static_cast<std::uint16_t>((random_ >> 30) & 1),
                                 static_cast<std::uint32_t>(n * 10)});
      }
      show(packet);
    }
  }

  /// The rounded front of something comes from that far away at that velocity.
  void approach(Pixel offset, PixelVelocity velocity, int milliseconds) {
    MovingContour mallet(contour_, {puck_.x + offset.x, puck_.y + offset.y}, velocity);
    for (int i = 0; i < milliseconds; ++i) {
      const std::int64_t from_us = i * 1000;
      std::vector<TimedEvent> front = mallet.events(from_us, from_us + 1000);
      const double y = mallet.position_at(from_us).y;
      std::erase_if(front, [&](const TimedEvent& event) { return event.y < y; });
      show(packet_of(front, kTableSensor, now_us_, from_us));
    }
  }

  /// Events that a px of contour makes on each px of its way.
  double density = 3;
  /// Pixels that fire at random all the while, so many a millisecond.
  int noise_a_ms = 0;
  /// There is a print on the puck's face.
  bool has_print = false;
  /// The puck's side wall makes events where the calibration says that it does not.
  void show_other_wall() { wall_share_ = contour_.other_wall_share(); }
  void put(Pixel position) { puck_ = position; }
  double error_px() const {
    if (!estimate_.position) return 100;
    return distance_px(*estimate_.position, puck_);
  }
  const PuckEstimate& estimate() const { return estimate_; }

 private:
  static ContourCalibration exact() { return {0, 0, 0}; }
  static HypothesesParams with_exact(HypothesesParams params) {
    params.contour = exact();
    return params;
  }

  void add_noise(EventPacket& packet) {
    for (int n = 0; n < noise_a_ms; ++n) packet.events.push_back(stray(n * 1000 / noise_a_ms));
    std::stable_sort(packet.events.begin(), packet.events.end(),
                     [](const Event& a, const Event& b) { return a.offset_us < b.offset_us; });
  }

  Event stray(int offset_us) {
    random_ = random_ * 1664525u + 1013904223u;
    const std::uint32_t x = (random_ >> 8) % 320;
    random_ = random_ * 1664525u + 1013904223u;
    const std::uint32_t y = (random_ >> 8) % 240;
    return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
            static_cast<std::uint16_t>(random_ >> 31), static_cast<std::uint32_t>(offset_us)};
  }

  void show(EventPacket packet) {
    if (noise_a_ms > 0) add_noise(packet);
    if (!packet.empty()) tracker_.update(packet);
    now_us_ += 1000;
    estimate_ = tracker_.estimate();
  }

  PuckContour contour_;
  double wall_share_ = 0;
  SurfaceTracker tracker_;
  Pixel puck_{60, 100};
  PuckEstimate estimate_;
  std::int64_t now_us_ = 0;
  std::uint32_t random_;
};

}  // namespace puck::test
