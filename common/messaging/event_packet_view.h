#pragma once

#include <cstdint>
#include <span>

#include "common/messaging/channels.h"

namespace puck {

/// A received event_packet_t whose events are not copied, for subscribers that unpack many packets.
/// Same fields as the message. Valid as long as the received bytes, that is, during the handler's
/// call.
struct EventPacketView {
  std::int64_t utime = 0;
  std::int64_t session = 0;
  std::int64_t seq = 0;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int64_t first_event_us = 0;
  std::int64_t duration_us = 0;
  std::int64_t sensor_zero_utime = 0;
  std::int64_t events_before = 0;
  std::int64_t events_dropped = 0;
  bool recorded = false;
  std::int32_t encoding = 0;
  std::int32_t count = 0;
  std::int32_t size = 0;
  std::span<const std::uint8_t> data;
};

template <>
inline constexpr Channel kChannelOf<EventPacketView> = Channel::kEvents;

/// Requires bytes that passed check_message().
void decode_checked(std::span<const std::uint8_t> bytes, EventPacketView& packet);

EventPacketView view_of(const event_packet_t& packet);

}  // namespace puck
