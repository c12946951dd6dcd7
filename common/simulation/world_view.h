#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/simulation/camera_view.h"
#include "common/simulation/projected_shape.h"
#include "common/simulation/scene_params.h"
#include "common/simulation/scene_renderer.h"
#include "common/simulation/table_game.h"
#include "common/table/table_geometry.h"

namespace puck {

/// Appearance of the game to a camera: the bodies to draw and the puck's truth.
class WorldView {
 public:
  WorldView(const TableGeometry& table, const SceneParams& scene, SensorSize size);

  /// Bodies in a fixed order; see `nearest_first`. An absent body has no shapes. A player has two:
  /// his mallet on the table, and above it his arm with the mallet's knob.
  enum Body {
    kPuck,
    kRobot,
    kRobotArm,
    kOpponent,
    kOpponentArm,
    kFreeHand,
    kSecondPuck,
    kBodyCount
  };

  SceneBody body(Body which, const TableGame& game, const CameraView& view) const;
  /// Indices of the bodies, front to back, for a camera that looks down on the table along its
  /// length: those above the table first, then those on it, each by distance.
  static std::vector<int> nearest_first(const TableGame& game);
  /// The body's place on the table; `std::nullopt` for an absent body.
  static std::optional<TablePoint> place_of(Body which, const TableGame& game);

  /// The puck's silhouette in the image.
  PixelBox puck_box(TablePoint puck, const CameraView& view) const;
  /// Share of the puck's silhouette that is inside the image and not covered, 0 to 1.
  double visible_share(const TableGame& game, const CameraView& view) const;

 private:
  ProjectedCylinder puck_shape(TablePoint puck, const CameraView& view) const;
  SceneBody puck_body(TablePoint puck, const CameraView& view) const;
  SceneBody mallet_body(TablePoint mallet, const CameraView& view) const;
  SceneBody arm_body(Body which, TablePoint mallet, const CameraView& view) const;

  TableGeometry table_;
  SceneParams scene_;
  SensorSize size_;
};

}  // namespace puck
