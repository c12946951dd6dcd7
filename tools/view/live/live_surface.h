#pragma once

#include <cstdint>
#include <optional>

#include "common/events/event_packet.h"
#include "common/vision/surface/surface.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// The EROS surface of preset `default`, computed only while somebody looks at it. Times are
/// CLOCK_MONOTONIC, µs. One thread.
class LiveSurface {
 public:
  /// Forgets all events.
  void reset(SensorSize sensor);

  /// Does nothing unless fill() was called within the last second.
  void update(const EventPacket& packet, std::int64_t now_us);

  /// Fills the scene's surface: of the events since the first of these calls.
  void fill(ViewScene& scene, std::int64_t now_us);

 private:
  SensorSize sensor_{};
  std::int64_t wanted_us_ = 0;
  std::optional<Surface> surface_;
  SurfaceSnapshot snapshot_;
};

}  // namespace puck
