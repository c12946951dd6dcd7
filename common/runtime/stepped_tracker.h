#pragma once

#include <chrono>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/runtime/shared_surface.h"
#include "common/runtime/tracking_thread.h"
#include "common/vision/puck_pipeline.h"
#include "common/vision/puck_size_model.h"
#include "common/vision/surface_tracker.h"

namespace puck {

/// What a LiveTracker does, in one thread and one step after the other: every event is taken, each
/// search is made at once, at its sensor time, and every estimate that is made is published. So
/// nothing depends on how busy the machine was but after which packets it was asked, which the
/// estimates tell: who has the packets and the estimates can make each of them again, to the bit.
/// The price is latency: packets wait for searches. One thread.
class SteppedTracker {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  SteppedTracker(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model,
                 const TrackingThreadParams& thread_params, TrackingThread::Publish publish);

  /// Takes a packet, which must not be empty, and publishes an estimate when one is due.
  void update(const EventPacket& packet, const PacketOrigin& origin);

  /// Publishes what is due without a new packet: the estimate that had to wait, or the last once
  /// more when it has been silent for as long as it may. To be called again and again.
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
