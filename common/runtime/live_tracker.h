#pragma once

#include <cstdint>
#include <utility>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/runtime/shared_surface.h"
#include "common/runtime/tracking_thread.h"
#include "common/vision/make_pipeline.h"
#include "common/vision/paper/puck_search.h"

namespace puck {

/// The paper's Figure 2, for one run of one camera: the caller of update(), the event thread,
/// updates the surface with every event; a second thread detects and tracks on copies of it.
/// Neither waits for the other's work, except for a step that the event thread makes itself.
class LiveTracker {
 public:
  /// Starts the second thread, which calls `publish` (see TrackingThread). Throws
  /// std::invalid_argument, naming the key, when a parameter is out of range.
  LiveTracker(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model,
              const TrackingThreadParams& thread_params, TrackingThread::Publish publish)
      : surface_(sensor, search_params(params).surface_params(),
                 {.roi_only = is_roi_only(params), .keeps_fresh = searches_fresh(params)}),
        thread_(surface_, make_pipeline(sensor, params, size_model),
                PuckSearch(sensor, search_params(params), size_model), thread_params,
                std::move(publish)) {}

  /// Event thread only. Applies a packet, which must not be empty. `more_waiting`: other packets
  /// are waiting, so the step is left to the tracking thread.
  void update(const EventPacket& packet, const PacketOrigin& origin, bool more_waiting) {
    surface_.update(packet, origin, more_waiting);
    if (!more_waiting) thread_.look_now();
  }

  /// Safe from any thread. Events thinned out because the tracking thread was behind.
  std::int64_t events_thinned() const { return surface_.events_thinned(); }

 private:
  SharedSurface surface_;
  TrackingThread thread_;
};

}  // namespace puck
