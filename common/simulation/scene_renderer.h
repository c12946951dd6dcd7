#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/events/timestamp.h"
#include "common/simulation/convex_outline.h"
#include "common/simulation/event_sensor.h"
#include "common/simulation/panorama.h"
#include "common/simulation/row_blend.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// Draws the bodies over the static scene and passes changed pixels to the sensor; pixels that
/// cannot have changed are skipped.
class SceneRenderer {
 public:
  /// `margin`: how far a turned camera can see beyond the home pose's image.
  SceneRenderer(const StaticScene& scene, const CameraView& home, SensorSize size,
                Panorama::Margin margin);

  /// `view`: the camera's pose at `to`; its pose at `from` is that of the last call. Draws the
  /// static scene, except the pixels up to `reach_px` around the bodies, which the next
  /// `draw_bodies` draws.
  void turn_camera(const CameraView& view, int reach_px, Timestamp from, Timestamp to,
                   EventSensor& sensor);

  /// Draws the bodies in their places at `to`. `nearest_first`: their indices, front to back.
  /// `moved[i]`: body i has changed since the last call.
  void draw_bodies(const std::vector<SceneBody>& bodies, const std::vector<int>& nearest_first,
                   const std::vector<bool>& moved, Timestamp from, Timestamp to,
                   EventSensor& sensor);

  /// ln(luminance) of the static scene in the present pose.
  ImageView<const float> background() const { return background_.view(); }

 private:
  /// Row-major homography from the turned camera's pixels to those of the home pose.
  using Warp = std::array<float, 9>;
  bool is_busy(const Region& block, const Warp& warp) const;
  void draw_block(const Region& block, const Warp& warp, Timestamp from, Timestamp to,
                  EventSensor& sensor);

  void reserve_around(const SceneBody& body, int reach_px);
  void mark_changes(const SceneBody& before, const SceneBody& now, bool everything);
  void mark(int y, Columns columns);
  void draw_columns(int y, Columns columns, const std::vector<SceneBody>& bodies,
                    const std::vector<int>& nearest_first, Timestamp from, Timestamp to,
                    EventSensor& sensor);

  CameraView home_;
  SensorSize size_;
  Panorama panorama_;
  Image<float> background_;
  std::vector<bool> was_busy_;  ///< Of each block of the background, in the previous pose.

  std::vector<SceneBody> drawn_;  ///< The bodies as last drawn.
  std::vector<int> drawn_nearest_first_;
  Image<std::uint8_t> reserved_;  ///< Pixels that `turn_camera` leaves to `draw_bodies`.
  std::vector<std::vector<Columns>> to_draw_;  ///< Columns to draw in each row.

  RowBlend blend_;
};

}  // namespace puck
