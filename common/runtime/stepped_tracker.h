#pragma once

#include <chrono>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/runtime/shared_surface.h"
#include "common/runtime/tracking_thread.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/make_pipeline.h"
#include "common/vision/surface_tracker.h"

namespace puck {

/// A single-threaded LiveTracker without timing effects: it takes every event, runs each search at
/// once at its sensor time, and publishes every estimate. The result depends on the machine's load
/// only through the packets after which an estimate was requested, and the estimates state those:
/// with the packets, each estimate can be reproduced to the bit. The cost is latency, since packets
/// wait for searches. One thread.
class SteppedTracker {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  SteppedTracker(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model,
                 const TrackingThreadParams& thread_params, TrackingThread::Publish publish);

  /// Applies a packet, which must not be empty, and publishes an estimate when one is due.
  void update(const EventPacket& packet, const PacketOrigin& origin);

  /// Publishes an estimate that is due without a new packet: one delayed by the rate limit, or the
  /// last one again as a heartbeat. Call it regularly.
  void poll();

 private:
  using Clock = std::chrono::steady_clock;

  void publish(Clock::time_point now);

  SurfaceTracker tracker_;
  std::chrono::microseconds period_;
  std::chrono::microseconds heartbeat_;
  TrackingThread::Publish publish_;
  TrackedEstimate newest_;
  PacketOrigin origin_;
  bool has_news_ = false;
  Clock::time_point next_publish_;
  Clock::time_point heartbeat_due_;
};

}  // namespace puck
