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

/// What the things on the table look like from a camera: the bodies to draw and the puck's truth.
class WorldView {
 public:
  WorldView(const TableGeometry& table, const SceneParams& scene, SensorSize size);

  /// Bodies in a fixed order; see `nearest_first`. What is not there is a body without shapes. A
  /// player is two: his mallet, which stands on the table, and above it his arm with the mallet's
  /// knob.
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
  /// From a camera that looks down on the table along it: first what is above the table, then what
  /// stands on it, each by how far away it is.
  static std::vector<int> nearest_first(const TableGame& game);
  /// Where the body stands, on the table; nothing for what is not there.
  static std::optional<TablePoint> place_of(Body which, const TableGame& game);

  /// The puck's silhouette in the image.
  PixelBox puck_box(TablePoint puck, const CameraView& view) const;
  /// Share of the puck's silhouette inside the image that nothing covers.
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
