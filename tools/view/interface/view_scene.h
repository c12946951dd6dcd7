#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/table/intercept_predictor.h"
#include "common/table/puck_track.h"
#include "common/table/table_geometry.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/truth_row.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "tools/view/interface/newest_events.h"

namespace puck {

/// Trackers whose estimates are shown at the same time.
inline constexpr int kViewSides = 2;

/// A track as the camera's picture shows it.
struct ViewTrack {
  /// Age of the oldest point of the trail.
  static constexpr std::int64_t kTrail_us = 1'000'000;

  struct TrailPoint {
    Timestamp time;
    std::optional<Pixel> position;  ///< Empty: no track; interrupts the trail.
  };

  std::string name;                      ///< "default", "cluster", …; empty: this side is off.
  std::optional<PuckEstimate> estimate;  ///< The newest one at the scene's time.
  std::vector<TrailPoint> trail;         ///< Oldest first.
};

/// The game as the table's picture shows it; the frame is that of TablePoint.
struct ViewTable {
  enum class Validity : std::uint8_t { kNone, kCoasting, kTracked };  ///< As puck_trajectory_t's.

  TableGeometry geometry;
  Validity validity = Validity::kNone;
  PuckTrack puck;                     ///< Unless validity is kNone.
  std::vector<PathPoint> path;        ///< Predicted; empty: none.
  std::optional<Intercept> crossing;  ///< Of the robot's line.
  std::optional<double> mallet_y_m;   ///< On the robot's line.
  std::optional<double> target_y_m;   ///< Of the commanded mallet.
  std::optional<TablePoint> truth;    ///< The true puck, in play.
  std::string phase;                  ///< "rally", "shot at robot", …; empty: unknown.
  std::int32_t goals_for = 0;         ///< The robot's.
  std::int32_t goals_against = 0;
  std::int32_t shots = 0;
  std::int32_t saves = 0;
};

/// All that a picture shows, as plain data. A ViewSource fills it; buffers are reused.
struct ViewScene {
  SensorSize sensor;   ///< {0, 0}: not known yet.
  Timestamp time;      ///< Sensor time of the picture.
  double seconds = 0;  ///< The same as shown: since the first event.

  NewestEvents events;          ///< If the backdrop is kEvents.
  Image<std::uint8_t> surface;  ///< If it is kSurface: the sensor's size, 0 to 255.
  Image<std::uint8_t> heat;     ///< If it is kHeatMap: the sensor's size; score 0 to 1 as 0 to 255.
  /// Words in place of a backdrop that cannot be drawn, such as a heat map without a size model.
  std::string no_backdrop;

  std::array<ViewTrack, kViewSides> tracks;
  std::optional<TruthRow> truth;
  std::optional<ViewTable> table;  ///< Empty: nothing tells the table's place in the image.
  std::string no_table;            ///< Then: why, and what to do.
};

}  // namespace puck
