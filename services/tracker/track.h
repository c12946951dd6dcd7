#pragma once

#include <cstdint>
#include <memory>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/runtime/shared_surface.h"
#include "common/runtime/tracking_thread.h"
#include "common/vision/puck_pipeline.h"
#include "services/tracker/tracker_params.h"

namespace puck {

/// Tracking of one run of one camera, as used by the thread that receives its packets.
class Track {
 public:
  virtual ~Track() = default;

  /// Takes the next packet, which must not be empty. `more_waiting`: more packets wait.
  virtual void update(const EventPacket& packet, const PacketOrigin& origin, bool more_waiting) = 0;
  /// Call it repeatedly, also without packets.
  virtual void poll() = 0;
  /// Number of events thinned out because the tracking was behind.
  virtual std::int64_t events_thinned() const = 0;
};

/// Uses two threads, or only the caller's if reproducible. `pipeline` replaces that of `params`.
/// Throws std::invalid_argument that names the key when a parameter is out of its range.
std::unique_ptr<Track> make_track(SensorSize sensor, const PipelineParams& pipeline,
                                  const TrackerServiceParams& params,
                                  TrackingThread::Publish publish);

}  // namespace puck
