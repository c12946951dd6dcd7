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
  /// A UDP payload that fits one Ethernet frame: the only safe size on a network that may lose
  /// frames. On loopback 60000 costs less.
  static constexpr int kOneFrame = 1472;
  static constexpr int kMinBytes = 256;
  static constexpr int kMaxBytes = 60000;

  SensorSize sensor;
  int packet_bytes = kOneFrame;  ///< Largest datagram: LCM's header, channel name and message.
};

/// Turns events into packets that each stand alone. The encoding follows from the sensor's size.
/// One thread.
class EventPacker {
 public:
  /// Throws std::invalid_argument, naming packer.sensor or packer.packet_bytes.
  explicit EventPacker(const EventPackerParams& params);

  /// Hands all the events over, in as few packets as the byte limit and the encoding's longest time
  /// allow; the last may be short. Events are in the order of their times, which lie `offset_us`
  /// after `start`. The packet given to `emit` is used again, so it may not be kept; its header,
  /// sensor_zero_utime and events_dropped are the caller's to fill in, the rest must stay as it is.
  /// Events outside the sensor are left out and counted.
  void pack(Timestamp start, std::span<const Event> events,
            const std::function<void(event_packet_t&)>& emit);

  /// Events packed so far.
  std::int64_t events_packed() const { return events_packed_; }
  std::int64_t events_outside() const { return events_outside_; }
  int max_events() const { return max_events_; }  ///< In one packet.
  int encoding() const { return packet_.encoding; }

 private:
  SensorSize sensor_;
  int max_events_ = 0;
  std::int64_t events_packed_ = 0;
  std::int64_t events_outside_ = 0;
  event_packet_t packet_;
};

/// The events of a packet that was received from a Bus or passed check_message(). `events` takes
/// them in the memory that it has; its start is the time of the first event.
void unpack(const EventPacketView& packet, EventPacket& events);
inline void unpack(const event_packet_t& packet, EventPacket& events) {
  unpack(view_of(packet), events);
}

}  // namespace puck
