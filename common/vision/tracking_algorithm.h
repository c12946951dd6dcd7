#pragma once

#include "common/events/event_packet.h"
#include "common/vision/puck_estimate.h"

namespace puck {

/// Anything that follows the puck: fed with events in the order of their times, asked for an
/// estimate whenever one is wanted. What it answers depends on nothing but the events and on when
/// it was asked, so that runs can be repeated to the bit. One thread at a time.
class TrackingAlgorithm {
 public:
  virtual ~TrackingAlgorithm() = default;

  virtual void update(const EventPacket& packet) = 0;
  virtual PuckEstimate estimate() = 0;
};

}  // namespace puck
