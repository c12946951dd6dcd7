#pragma once

#include <cstdint>
#include <span>

#include "common/messaging/channels.h"

namespace puck {

/// An event_packet_t as it lies in the bytes that came, its events not copied: what those subscribe
/// to who unpack many packets. The fields are those of the message. It lives as long as the bytes,
/// that is, as long as the call of the handler.
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

/// Only for bytes that check_message() let pass.
void decode_checked(std::span<const std::uint8_t> bytes, EventPacketView& packet);

EventPacketView view_of(const event_packet_t& packet);

}  // namespace puck
