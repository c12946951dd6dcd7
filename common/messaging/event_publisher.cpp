#include "common/messaging/event_publisher.h"

namespace puck {

void EventPublisher::publish(const EventPacket& events, const EventSourceFacts& source) {
  packer_.pack(events.start, events.events, [&](event_packet_t& packet) {
    packet.sensor_zero_utime = source.sensor_zero_utime;
    packet.events_dropped = source.events_dropped;
    packet.recorded = source.is_recorded;
    if (bus_.publish(packet)) ++packets_sent_;
  });
}

}  // namespace puck
