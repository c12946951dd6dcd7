#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/events/timestamp.h"
#include "common/simulation/convex_outline.h"
#include "common/simulation/event_sensor.h"
#include "common/simulation/panorama.h"
#include "common/simulation/row_blend.h"
#include "common/vision/image.h"
#include "common/vision/region.h"

namespace puck {

/// Draws the bodies over the static scene and tells the sensor what changed; pixels on which
/// nothing can have changed are left alone.
class SceneRenderer {
 public:
  /// `margin`: how far the turned camera may look beyond the home pose's image.
  SceneRenderer(const StaticScene& scene, const CameraView& home, SensorSize size,
                Panorama::Margin margin);

  /// The camera's pose at `to`; at `from` it was as told last time. Draws the static scene, but
  /// leaves the pixels around the bodies, up to `reach_px` from them, to the next `draw_bodies`.
  void turn_camera(const CameraView& view, int reach_px, Timestamp from, Timestamp to,
                   EventSensor& sensor);

  /// Draws the bodies as they stand at `to`. `nearest_first`: their indices, in the order in which
  /// they hide each other. `moved[i]`: body i is not as it was last time.
  void draw_bodies(const std::vector<SceneBody>& bodies, const std::vector<int>& nearest_first,
                   const std::vector<bool>& moved, Timestamp from, Timestamp to,
                   EventSensor& sensor);

  /// ln(luminance) of the static scene in the present pose.
  ImageView<const float> background() const { return background_.view(); }

 private:
  /// Where in the home pose's image each pixel of the turned camera looks; row by row.
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
  std::vector<bool> was_busy_;  ///< Each block of the background, in the pose before.

  std::vector<SceneBody> drawn_;  ///< The bodies as they were drawn last.
  std::vector<int> drawn_nearest_first_;
  Image<std::uint8_t> reserved_;               ///< Left to `draw_bodies` by `turn_camera`.
  std::vector<std::vector<Columns>> to_draw_;  ///< For each row.

  RowBlend blend_;
};

}  // namespace puck
