#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/truth_row.h"
#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

/// The content of a picture: a tracked puck at one moment.
struct TrackedMoment {
  /// Age of the oldest shown event and trail point.
  static constexpr std::int64_t kEventsUs = 20'000;
  static constexpr std::int64_t kTrailUs = 500'000;

  struct TrailPoint {
    Timestamp time;
    std::optional<Pixel> position;  ///< Empty: lost; interrupts the trail.
  };

  SensorSize sensor;
  Timestamp time;
  double seconds = 0;  ///< Time shown in the picture.
  EventPacket events;  ///< In order of time; those outside of kEventsUs are not drawn.
  PuckEstimate estimate;
  std::vector<TrailPoint> trail;  ///< Oldest first.
  std::optional<TruthRow> truth;
};

/// Draws a moment: events by polarity, older ones fainter; the trail; the estimate's ellipse and
/// velocity; the true ellipse, thin; above them time, state, speed and error, below them a legend.
/// 8-bit BGR, a whole multiple of the sensor's size and at least kPictureWidthPx wide.
cv::Mat draw_picture(const TrackedMoment& moment);

inline constexpr int kPictureWidthPx = 1200;
/// Rows above the sensor's image: sensor position (x, y) is drawn at scale * (x + 0.5, y + 0.5),
/// this many rows down.
inline constexpr int kPictureHeaderPx = 48;

/// Canvas pixels per sensor pixel.
constexpr int picture_scale(SensorSize sensor) {
  return (kPictureWidthPx + sensor.width - 1) / sensor.width;
}

}  // namespace puck
