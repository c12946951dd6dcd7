#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/messaging/event_packet_view.h"
#include "puck/event_packet_t.hpp"

namespace puck {

struct EventPackerParams {
  /// UDP payload of one Ethernet frame: the only safe size on a network that may lose frames. On
  /// loopback, 60000 costs less.
  static constexpr int kOneFrame = 1472;
  static constexpr int kMinBytes = 256;
  static constexpr int kMaxBytes = 60000;

  SensorSize sensor;
  int packet_bytes = kOneFrame;  ///< Largest datagram: LCM's header, channel name and message.
};

/// Packs events into packets that each can be decoded alone. The encoding follows from the sensor's
/// size. One thread.
class EventPacker {
 public:
  /// Throws std::invalid_argument, naming packer.sensor or packer.packet_bytes.
  explicit EventPacker(const EventPackerParams& params);

  /// Packs all events into as few packets as the byte limit and the encoding's longest time allow;
  /// the last one may be short. Events are in the order of their times, `offset_us` after `start`.
  /// The packet given to `emit` is reused, so it must not be kept; the caller fills in its header,
  /// sensor_zero_utime and events_dropped and leaves the rest. Events outside the sensor are
  /// skipped and counted.
  void pack(Timestamp start, std::span<const Event> events,
            const std::function<void(event_packet_t&)>& emit);

  /// The next packet is the first one of a session: its `events_before` is 0.
  void begin_session() { packed_before_session_ = events_packed_; }

  /// Events packed so far, in all sessions.
  std::int64_t events_packed() const { return events_packed_; }
  std::int64_t events_outside() const { return events_outside_; }
  int max_events() const { return max_events_; }  ///< For one packet.
  int encoding() const { return packet_.encoding; }

 private:
  SensorSize sensor_;
  int max_events_ = 0;
  std::int64_t events_packed_ = 0;
  std::int64_t packed_before_session_ = 0;
  std::int64_t events_outside_ = 0;
  event_packet_t packet_;
};

/// Unpacks a packet that was received from a Bus or passed check_message(). `events` reuses its
/// memory; its start is the time of the first event.
void unpack(const EventPacketView& packet, EventPacket& events);
inline void unpack(const event_packet_t& packet, EventPacket& events) {
  unpack(view_of(packet), events);
}

}  // namespace puck
