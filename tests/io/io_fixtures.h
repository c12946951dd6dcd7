#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "common/events/event_packet.h"
#include "common/io/event_decoder.h"
#include "common/io/event_reader.h"
#include "tests/support/temporary_folder.h"

namespace puck {

/// An event with its full time, for comparisons.
struct PlainEvent {
  std::int64_t t_us = 0;
  int x = 0;
  int y = 0;
  int polarity = 0;

  friend bool operator==(const PlainEvent&, const PlainEvent&) = default;
};

inline void append_plain(const EventPacket& packet, std::vector<PlainEvent>& events) {
  for (const Event& event : packet.events) {
    events.push_back({packet.time_of(event).us, event.x, event.y, event.polarity});
  }
}

inline EventPacket packet_of(const std::vector<PlainEvent>& events) {
  EventPacket packet;
  if (!events.empty()) packet.start = {events.front().t_us};
  for (const PlainEvent& plain : events) {
    Event event;
    event.x = static_cast<std::uint16_t>(plain.x);
    event.y = static_cast<std::uint16_t>(plain.y) & 0x7fff;
    event.polarity = plain.polarity ? 1 : 0;
    event.offset_us = static_cast<std::uint32_t>(plain.t_us - packet.start.us);
    packet.events.push_back(event);
  }
  return packet;
}

inline std::vector<PlainEvent> read_all(EventReader& reader, std::size_t max_events = 1000) {
  std::vector<PlainEvent> events;
  EventPacket packet;
  while (reader.read(packet, max_events)) append_plain(packet, events);
  return events;
}

template <typename Word>
std::vector<std::byte> bytes_of(const std::vector<Word>& words) {
  std::vector<std::byte> bytes;
  for (const Word word : words) {
    for (std::size_t i = 0; i < sizeof(Word); ++i) {
      bytes.push_back(static_cast<std::byte>((word >> (8 * i)) & 0xff));
    }
  }
  return bytes;
}

/// All events that the decoder makes of the bytes in pieces of this length.
inline std::vector<PlainEvent> decode_all(EventDecoder& decoder, std::span<const std::byte> bytes,
                                          std::size_t piece = 1 << 20,
                                          std::size_t max_events = 1 << 20) {
  std::vector<PlainEvent> events;
  EventPacket packet;
  const auto feed = [&](std::span<const std::byte> part) {
    do {
      packet.events.clear();
      part = part.subspan(decoder.decode(part, packet, max_events));
      append_plain(packet, events);
    } while (!part.empty() || decoder.has_backlog());
  };
  while (!bytes.empty()) {
    const std::size_t length = std::min(piece, bytes.size());
    feed(bytes.first(length));
    bytes = bytes.subspan(length);
  }
  decoder.finish();
  feed({});
  return events;
}

/// The message of the exception that `action` throws; empty without one.
template <typename Error, typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace puck
