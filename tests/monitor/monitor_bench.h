#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/messaging/event_packing.h"
#include "common/messaging/message_codec.h"
#include "common/monitor/bus_monitor.h"

namespace puck {

/// A model for tests, with simulated times.
struct MonitorBench {
  BusMonitor model;

  explicit MonitorBench(const std::string& prefix = {}, const MonitorParams& params = {})
      : model(prefix, params, 0) {}

  template <typename Message>
  void hear(Message message, std::int64_t session, std::int64_t seq, std::int64_t time_us,
            const std::string& prefix = {}) {
    message.session = session;
    message.seq = seq;
    std::vector<std::uint8_t> bytes;
    encode(message, bytes);
    hear_bytes(channel_name(kChannelOf<Message>, prefix), bytes, time_us);
  }
  void hear_bytes(const std::string& channel, const std::vector<std::uint8_t>& bytes,
                  std::int64_t time_us) {
    model.hear(channel, bytes, {.monotonic_us = time_us, .bytes = bytes.size()});
  }
};

/// A camera's packet with so many events.
inline event_packet_t packet_of(std::size_t events) {
  event_packet_t made{};
  EventPacker packer({.sensor = {640, 480}, .packet_bytes = EventPackerParams::kMaxBytes});
  packer.pack({1000}, std::vector<Event>(events, Event{.x = 3, .y = 4, .polarity = 1}),
              [&](event_packet_t& packet) { made = packet; });
  return made;
}

inline service_status_t status_of(const std::string& service, const std::string& host = "robot",
                                  std::int32_t pid = 42) {
  service_status_t status{};
  status.service = service;
  status.host = host;
  status.pid = pid;
  status.version = "0.1.0";
  status.state = service_status_t::STATE_RUNNING;
  status.uptime_us = 5'000'000;
  return status;
}

}  // namespace puck
