#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/messaging/event_packing.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"

namespace puck {

/// Writes the events of a camera's sessions into a log, as a logger would. A packet is logged at
/// the time of its first event, on a host clock whose zero is that of sensor time. One thread.
class EventLogWriter {
 public:
  explicit EventLogWriter(const std::filesystem::path& path, SensorSize sensor,
                          std::string channel = "PUCK_EVENTS")
      : log_(path), sensor_(sensor), channel_(std::move(channel)), packer_({sensor, 60000}) {}

  /// Starts a session with numbers from 0, and logs packets `later_us` after their sensor time.
  void begin_session(std::int64_t session, std::int64_t later_us) {
    session_ = session;
    later_us_ = later_us;
    seq_ = 0;
    packer_ = EventPacker({sensor_, 60000});
  }
  void write(const EventPacket& events) {
    each(events, [this](event_packet_t& packet) { log_as(packet); });
  }
  /// Counts a packet as sent, but not received.
  void lose(const EventPacket& events) {
    each(events, [](event_packet_t&) {});
  }
  /// Writes the packet unchanged; `utime`: the log's stamp.
  void write_raw(event_packet_t packet, std::int64_t utime) {
    std::vector<std::uint8_t> bytes;
    encode(packet, bytes);
    log_.write(channel_, utime, bytes);
  }
  void write_bytes(const std::string& channel, std::int64_t utime,
                   const std::vector<std::uint8_t>& bytes) {
    log_.write(channel, utime, bytes);
  }
  /// The packet that was written last.
  const event_packet_t& last() const { return last_; }
  void flush() { log_.flush(); }

 private:
  template <typename Take>
  void each(const EventPacket& events, const Take& take) {
    packer_.pack(events.start, events.events, [&](event_packet_t& packet) {
      packet.utime = packet.first_event_us + later_us_;
      packet.session = session_;
      packet.seq = seq_++;
      take(packet);
    });
  }
  void log_as(const event_packet_t& packet) {
    last_ = packet;
    write_raw(packet, packet.utime);
  }

  LogWriter log_;
  SensorSize sensor_;
  std::string channel_;
  EventPacker packer_;
  std::int64_t session_ = 1;
  std::int64_t later_us_ = 0;
  std::int64_t seq_ = 0;
  event_packet_t last_{};
};

/// `count` events `gap_us` apart from `start_us` on, each at a place of its own.
inline EventPacket numbered_events(std::int64_t start_us, int count, std::int64_t gap_us = 10) {
  EventPacket packet{{start_us}, {}};
  for (int i = 0; i < count; ++i) {
    Event event;
    event.x = static_cast<std::uint16_t>(i % 64);
    event.y = static_cast<std::uint16_t>(i / 64 % 48) & 0x7fff;
    event.polarity = 1;
    event.offset_us = static_cast<std::uint32_t>(i * gap_us);
    packet.events.push_back(event);
  }
  return packet;
}

}  // namespace puck
