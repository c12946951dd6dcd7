#include "tests/bench/encoded_streams.h"

#include <cstdint>
#include <span>
#include <string>

namespace puck {
namespace {

void put(std::string& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
}

void put_big_endian(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
}

std::string size_text(SensorSize sensor, std::string_view width, std::string_view height) {
  return std::string(width) + std::to_string(sensor.width) + std::string(height) +
         std::to_string(sensor.height) + "\n";
}

/// EVT2, EVT2.1 and EVT4: a time word each 64 µs, and a word an event.
std::string evt_bytes(std::string_view format, const EventPacket& events, SensorSize sensor) {
  const bool is_long = format == "evt21";
  const bool is_evt4 = format == "evt4";
  std::string bytes = "% evt " +
                      std::string(is_long   ? "2.1"
                                  : is_evt4 ? "4.0"
                                            : "2.0") +
                      "\n" + size_text(sensor, "% geometry ", "x") + "% end\n";
  const std::uint64_t time_type = is_evt4 ? 0xe : 0x8;
  std::int64_t high = -1;
  for (const Event& event : events.events) {
    const std::int64_t t_us = events.time_of(event).us;
    const auto low = static_cast<std::uint64_t>(t_us & 63);
    const auto word = [&](std::uint64_t type, std::uint64_t payload) {
      put(bytes, is_long ? type << 60 | payload << 32 : type << 28 | payload, is_long ? 8 : 4);
    };
    if (t_us >> 6 != high) {
      high = t_us >> 6;
      word(time_type, static_cast<std::uint64_t>(high) & 0x0fffffff);
    }
    const std::uint64_t x = is_long ? event.x & ~31U : event.x;
    const std::uint64_t place = low << 22 | x << 11 | event.y;
    if (is_long) {
      put(bytes,
          std::uint64_t{event.polarity} << 60 | place << 32 | std::uint64_t{1} << (event.x & 31U),
          8);
    } else {
      word((is_evt4 ? 0xaU : 0U) + event.polarity, place);
    }
  }
  return bytes;
}

std::string dat_bytes(const EventPacket& events, SensorSize sensor) {
  std::string bytes = "% Data file containing CD events\n% Version 2\n" +
                      size_text(sensor, "% Width ", "\n% Height ") + "\x0c\x08";
  for (const Event& event : events.events) {
    put(bytes, static_cast<std::uint64_t>(events.time_of(event).us), 4);
    put(bytes, event.x | event.y << 14U | std::uint64_t{event.polarity} << 28, 4);
  }
  return bytes;
}

std::string es_bytes(const EventPacket& events, SensorSize sensor) {
  std::string bytes("Event Stream\x02\0\0\x01", 16);
  put(bytes, static_cast<std::uint64_t>(sensor.width), 2);
  put(bytes, static_cast<std::uint64_t>(sensor.height), 2);
  std::int64_t newest_us = 0;
  for (const Event& event : events.events) {
    std::int64_t step_us = events.time_of(event).us - newest_us;
    newest_us += step_us;
    for (; step_us > 126; step_us -= 127) bytes += '\xff';
    put(bytes, static_cast<std::uint64_t>(step_us) << 1 | event.polarity, 1);
    put(bytes, event.x, 2);
    put(bytes, static_cast<std::uint64_t>(sensor.height - 1 - event.y), 2);
  }
  return bytes;
}

std::string aedat2_bytes(const EventPacket& events, SensorSize sensor) {
  std::string bytes = "#!AER-DAT2.0\r\n# AEChip: DAVIS" + std::to_string(sensor.width) + "\r\n";
  for (const Event& event : events.events) {
    const auto x = static_cast<std::uint32_t>(sensor.width - 1 - event.x);
    const auto y = static_cast<std::uint32_t>(sensor.height - 1 - event.y);
    put_big_endian(bytes, x << 12 | y << 22 | static_cast<std::uint32_t>(event.polarity) << 11);
    put_big_endian(bytes, static_cast<std::uint32_t>(events.time_of(event).us));
  }
  return bytes;
}

std::string text_bytes(const EventPacket& events, SensorSize sensor) {
  std::string bytes = size_text(sensor, "%geometry:", ",") + "t_us,x,y,p\n";
  for (const Event& event : events.events) {
    bytes += std::to_string(events.time_of(event).us) + "," + std::to_string(event.x) + "," +
             std::to_string(event.y) + "," + std::to_string(event.polarity) + "\n";
  }
  return bytes;
}

}  // namespace

std::vector<std::byte> encoded_stream(std::string_view format, const EventPacket& events,
                                      SensorSize sensor) {
  const std::string bytes = format == "dat"      ? dat_bytes(events, sensor)
                            : format == "es"     ? es_bytes(events, sensor)
                            : format == "aedat2" ? aedat2_bytes(events, sensor)
                            : format == "text"   ? text_bytes(events, sensor)
                                                 : evt_bytes(format, events, sensor);
  const auto all = std::as_bytes(std::span(bytes));
  return {all.begin(), all.end()};
}

}  // namespace puck
