#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

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

/// Writes what charts/picture.py draws, as JSON. Throws std::runtime_error on failure.
void write_moment(const TrackedMoment& moment, const std::filesystem::path& path);

/// Draws a moment as PNG: events by polarity, older ones fainter; the trail; the estimate's ellipse
/// and velocity; the true ellipse, thin; above them time, state, speed and error, below them a
/// legend. Throws std::runtime_error on failure; then PATH.json keeps the data.
void draw_picture(const TrackedMoment& moment, const std::filesystem::path& path);

}  // namespace puck
