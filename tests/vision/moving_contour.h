#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/vision/contour/puck_contour.h"
#include "common/vision/hypotheses/hypothesis.h"

namespace puck::test {

/// An ideal sensor's events of a puck at constant velocity: on its contour, as many as the swept
/// area in px² times `per_px2`, with the signs of a dark puck. `wall_share` as for
/// PuckContour::ring_at; below 0 a wall is visible below the puck's face.
class MovingContour {
 public:
  MovingContour(const PuckContour& contour, Pixel start, PixelVelocity velocity, double per_px2 = 3,
                double wall_share = 0)
      : contour_(contour),
        start_(start),
        velocity_(velocity),
        per_px2_(per_px2),
        wall_share_(wall_share) {}

  /// A disc of the other tone and of half its size on the puck's face makes events, too.
  bool has_print = false;

  Pixel position_at(std::int64_t time_us) const {
    const double s = static_cast<double>(time_us) * 1e-6;
    return {start_.x + velocity_.x * s, start_.y + velocity_.y * s};
  }

  /// The events from `from_us` to `to_us`, a step of 10 µs at a time.
  std::vector<TimedEvent> events(std::int64_t from_us, std::int64_t to_us) {
    std::vector<TimedEvent> made;
    for (std::int64_t t = from_us; t < to_us; t += 10) {
      const Pixel centre = position_at(t);
      const ContourRing ring = contour_.ring_at(centre, std::max(wall_share_, 0.0));
      const ContourRing whole = contour_.ring_at(centre, wall_share_);
      const double wall_px = whole.semi_y - whole.rise - (ring.semi_y - ring.rise);
      constexpr int kPlaces = 90;
      for (int i = 0; i < kPlaces; ++i) {
        const double angle = 2 * std::numbers::pi * (i + uniform()) / kPlaces;
        const double dy = ring.semi_y * std::sin(angle);
        const double dx = ring.semi_x * std::cos(angle) + ring.shear * dy;
        const ContourOffset place = ring.offset(dx, dy - ring.rise, 0);
        const double speed = place.normal_x * velocity_.x + place.normal_y * velocity_.y;
        const double length_px =
            2 * std::numbers::pi / kPlaces *
            std::hypot(ring.semi_x * std::sin(angle), ring.semi_y * std::cos(angle));
        if (uniform() > std::abs(speed) * 10e-6 * length_px * per_px2_) continue;
        const double wall = dy > whole.sides_slope * dx ? wall_px : 0;
        add(event_at(t, centre.x + dx, centre.y + dy - ring.rise + wall, speed < 0), centre, made);
      }
      for (const double side : {-1, 1}) {
        if (wall_px <= 0 || uniform() > std::abs(velocity_.x) * 10e-6 * wall_px * per_px2_)
          continue;
        const double dx = side * whole.drawn_out_semi_x();
        add(event_at(t, centre.x + dx,
                     centre.y + whole.sides_slope * dx - ring.rise + uniform() * wall_px,
                     side * velocity_.x < 0),
            centre, made);
      }
    }
    return made;
  }

 private:
  static TimedEvent event_at(std::int64_t time_us, double x, double y, bool on) {
    return {time_us, static_cast<float>(std::round(x)), static_cast<float>(std::round(y)), on,
            true};
  }

  void add(const TimedEvent& event, Pixel centre, std::vector<TimedEvent>& made) const {
    made.push_back(event);
    if (!has_print) return;
    made.push_back(
        event_at(event.time_us, (centre.x + event.x) / 2, (centre.y + event.y) / 2, !event.on));
  }

  double uniform() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

  const PuckContour& contour_;
  Pixel start_;
  PixelVelocity velocity_;
  double per_px2_;
  double wall_share_;
  std::uint64_t state_ = 1;
};

/// What of these events lies on a sensor, as a packet that starts at `start_us`; the events' times
/// count from `origin_us`.
inline EventPacket packet_of(const std::vector<TimedEvent>& events, SensorSize sensor,
                             std::int64_t start_us, std::int64_t origin_us) {
  EventPacket packet{{start_us}, {}};
  for (const TimedEvent& event : events) {
    if (!sensor.contains(static_cast<int>(event.x), static_cast<int>(event.y))) continue;
    Event made{static_cast<std::uint16_t>(event.x), 0, 0,
               static_cast<std::uint32_t>(event.time_us - origin_us)};
    made.y = static_cast<std::uint16_t>(event.y) & 0x7fffu;
    made.polarity = event.on ? 1 : 0;
    packet.events.push_back(made);
  }
  return packet;
}

}  // namespace puck::test
