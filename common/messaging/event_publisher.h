#pragma once

#include <cstdint>

#include "common/events/event_packet.h"
#include "common/messaging/bus.h"
#include "common/messaging/event_packing.h"

namespace puck {

/// What EVENTS says of the source of the events.
struct EventSourceFacts {
  std::int64_t sensor_zero_utime = 0;  ///< CLOCK_REALTIME, µs, at sensor time 0; 0: not known.
  std::int64_t events_dropped = 0;     ///< By the source so far.
  bool is_recorded = false;            ///< From a file or a log, not from a live sensor.
};

/// Publishes events as EVENTS, see EventPacker. One thread.
class EventPublisher {
 public:
  /// Throws std::invalid_argument, naming packer.sensor or packer.packet_bytes.
  EventPublisher(Bus& bus, const EventPackerParams& params) : bus_(bus), packer_(params) {}

  void publish(const EventPacket& events, const EventSourceFacts& source);

  /// As EventPacker's.
  void begin_session() { packer_.begin_session(); }

  const EventPacker& packer() const { return packer_; }
  std::int64_t packets_sent() const { return packets_sent_; }

 private:
  Bus& bus_;
  EventPacker packer_;
  std::int64_t packets_sent_ = 0;
};

}  // namespace puck
