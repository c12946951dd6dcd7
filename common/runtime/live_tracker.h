#pragma once

#include <utility>

#include "common/events/sensor_size.h"
#include "common/runtime/shared_surface.h"
#include "common/runtime/tracking_thread.h"
#include "common/vision/make_pipeline.h"
#include "common/vision/puck_search.h"

namespace puck {

/// The surface and the tracking thread for one run of one camera: the paper's Figure 2. The caller
/// of update() is the event thread.
struct LiveTracker {
  /// Starts the thread. Throws std::invalid_argument, naming the key, when a parameter is out of
  /// range.
  LiveTracker(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model,
              const TrackingThreadParams& thread_params, TrackingThread::Publish publish)
      : surface(sensor, params.eros,
                {.roi_only = params.roi_only, .keeps_fresh = params.searches_fresh()}),
        thread(surface, make_pipeline(sensor, params, size_model),
               PuckSearch(sensor, params, size_model), thread_params, std::move(publish)) {}

  /// Event thread only. Applies a packet, which must not be empty. `more_waiting`: other packets
  /// are waiting, so the step is left to the tracking thread.
  void update(const EventPacket& packet, const PacketOrigin& origin, bool more_waiting) {
    surface.update(packet, origin, more_waiting);
    if (!more_waiting) thread.look_now();
  }

  SharedSurface surface;
  TrackingThread thread;
};

}  // namespace puck
