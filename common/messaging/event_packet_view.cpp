#include "common/messaging/event_packet_view.h"

#include "common/messaging/byte_reader.h"
#include "common/messaging/wire_layout.h"

namespace puck {

void decode_checked(std::span<const std::uint8_t> bytes, EventPacketView& packet) {
  ByteReader reader(bytes);
  reader.take(kFingerprintBytes);
  packet.utime = reader.whole<std::int64_t>();
  packet.session = reader.whole<std::int64_t>();
  packet.seq = reader.whole<std::int64_t>();
  packet.width = reader.whole<std::int32_t>();
  packet.height = reader.whole<std::int32_t>();
  packet.first_event_us = reader.whole<std::int64_t>();
  packet.duration_us = reader.whole<std::int64_t>();
  packet.sensor_zero_utime = reader.whole<std::int64_t>();
  packet.events_before = reader.whole<std::int64_t>();
  packet.events_dropped = reader.whole<std::int64_t>();
  packet.recorded = reader.whole<std::int8_t>() != 0;
  packet.encoding = reader.whole<std::int32_t>();
  packet.count = reader.whole<std::int32_t>();
  packet.size = reader.whole<std::int32_t>();
  packet.data = reader.rest();
}

EventPacketView view_of(const event_packet_t& packet) {
  return {.utime = packet.utime,
          .session = packet.session,
          .seq = packet.seq,
          .width = packet.width,
          .height = packet.height,
          .first_event_us = packet.first_event_us,
          .duration_us = packet.duration_us,
          .sensor_zero_utime = packet.sensor_zero_utime,
          .events_before = packet.events_before,
          .events_dropped = packet.events_dropped,
          .recorded = packet.recorded != 0,
          .encoding = packet.encoding,
          .count = packet.count,
          .size = packet.size,
          .data = packet.data};
}

}  // namespace puck
