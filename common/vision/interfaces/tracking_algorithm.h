#pragma once

#include "common/events/event_packet.h"
#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

/// Interface of all trackers: takes events in the order of their times and gives an estimate on
/// demand. Estimates depend only on the events and the times of the demands, so that runs can be
/// repeated to the bit. One thread at a time.
class TrackingAlgorithm {
 public:
  virtual ~TrackingAlgorithm() = default;

  virtual void update(const EventPacket& packet) = 0;
  virtual PuckEstimate estimate() = 0;
};

}  // namespace puck
