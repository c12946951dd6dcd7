#pragma once

#include <cstdint>
#include <optional>

#include "common/events/packet_counters.h"
#include "common/events/sensor_size.h"
#include "common/messages/message_header.h"
#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

/// ESTIMATE: the tracker's estimate of the puck, and how it came about. Times are CLOCK_REALTIME of
/// the tracker's host, µs.
struct PublishedEstimate : MessageHeader, PuckEstimate {
  SensorSize sensor;
  std::int64_t events_session = 0;  ///< Of the event packets that it is based on.

  /// When the newest event happened at the sensor; with `is_live` corrected for the offset of the
  /// camera's clock, else by that clock. Empty: not known.
  std::optional<std::int64_t> event_utime;
  std::int64_t packet_received_utime = 0;   ///< When that event's packet was received.
  std::int64_t tracking_started_utime = 0;  ///< When the tracking step that used it began.
  std::int64_t backlog_us = 0;  ///< Sensor time received but not yet applied to the surface.
  std::int64_t backlog_events = 0;
  /// Its events happened just now: published by a camera whose clock is known, not recorded, not by
  /// the player of a log. Only such estimates move the arm.
  bool is_live = false;

  PacketCounters packets;  ///< Of the session of the events, so far.

  /// Whether it gives the puck's place now.
  bool is_tracking() const { return state == TrackState::kTracking && position.has_value(); }
};

}  // namespace puck
