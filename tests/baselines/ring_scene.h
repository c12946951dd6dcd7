#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/events/event_packet.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/interfaces/tracking_algorithm.h"
#include "tests/vision/puck_picture.h"
#include "tests/vision/test_sensor.h"

namespace puck::test {

/// Place of the puck's first appearance.
inline constexpr Pixel kStart{300, 190};

inline double distance_px(const PuckEstimate& estimate, Pixel truth) {
  if (!estimate.position) return 1e9;
  return std::hypot(estimate.position->x - truth.x, estimate.position->y - truth.y);
}

/// Shows a tracker the contour of a puck, a packet each millisecond, with its events spread evenly
/// over the millisecond in an order without a direction.
class RingScene {
 public:
  explicit RingScene(TrackingAlgorithm& tracker) : tracker_(tracker) {}

  PuckEstimate show(Pixel centre) {
    return give(contour_events(kSensor, centre, kSizeModel.at(centre), 150));
  }

  PuckEstimate give(std::vector<Event> events) {
    now_ = now_ + 1000;
    for (std::size_t i = events.size(); i > 1; --i) {
      order_ = order_ * 1664525u + 1013904223u;
      std::swap(events[i - 1], events[(order_ >> 8) % i]);
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
      events[i].offset_us = static_cast<std::uint32_t>(i * 1000 / events.size());
    }
    tracker_.update(EventPacket{now_, std::move(events)});
    return tracker_.estimate();
  }

  /// Shows the puck at rest until the tracker has detected it.
  PuckEstimate show_until_detected(Pixel centre) {
    PuckEstimate estimate = tracker_.estimate();
    for (int i = 0; i < 100 && estimate.state != TrackState::kTracking; ++i) {
      estimate = show(centre);
    }
    return estimate;
  }

  /// Moves the puck on from `start` for so many milliseconds. Returns the mean distance to it, px;
  /// `estimate` becomes the last estimate.
  double follow(Pixel start, int milliseconds, PuckEstimate& estimate) {
    double sum = 0;
    for (int i = 1; i <= milliseconds; ++i) {
      const Pixel truth{start.x + 0.6 * i, start.y + 0.3 * i};
      estimate = show(truth);
      sum += distance_px(estimate, truth);
    }
    return sum / milliseconds;
  }

  Timestamp now() const { return now_; }

 private:
  TrackingAlgorithm& tracker_;
  Timestamp now_;
  std::uint32_t order_ = 1;
};

/// An event outside the reach of the puck in the detection region.
inline Event far_event() { return {600, 400, 1, 0}; }

}  // namespace puck::test
