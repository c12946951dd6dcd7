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

/// One run of one camera, as the thread sees it that takes its packets.
class Track {
 public:
  virtual ~Track() = default;

  /// Takes the next packet, which must not be empty. `more_waiting`: others have come meanwhile.
  virtual void update(const EventPacket& packet, const PacketOrigin& origin, bool more_waiting) = 0;
  /// To be called again and again, also when no packet comes.
  virtual void poll() = 0;
  /// Events kept from the tracking because it was behind, so far.
  virtual std::int64_t events_thinned() const = 0;
};

/// In two threads, or, if it is to be reproducible, step by step in the caller's. `pipeline`
/// instead of the one in `params`. Throws std::invalid_argument, naming the key, when a parameter
/// is out of range.
std::unique_ptr<Track> make_track(SensorSize sensor, const PipelineParams& pipeline,
                                  const TrackerServiceParams& params,
                                  TrackingThread::Publish publish);

}  // namespace puck
