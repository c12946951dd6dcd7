#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>

#include "common/events/event_packet.h"

namespace puck {

/// Encoding of events in a YARP text log.
enum class YarpEncoding : std::uint8_t {
  kList,     ///< `AE (stamp address …)`, stamps in ticks of 80 ns.
  kStamped,  ///< `AE duration "bytes"`, a stamp in µs before each address.
  kPlain,    ///< `AE duration "bytes"`, addresses alone.
};

/// Writes packets of events as an IIT camera's YARP text log.
class YarpLogEncoder {
 public:
  /// `zero` is the first event's time; stamps begin at `first_stamp`.
  YarpLogEncoder(YarpEncoding encoding, Timestamp zero, std::uint32_t first_stamp = 383'033'170)
      : encoding_(encoding), zero_(zero), first_stamp_(first_stamp) {}

  /// Appends a line. `duration_us`: the packet's time span, up to its newest event.
  void add(const EventPacket& packet, std::int64_t duration_us, bool right_eye = true) {
    begin_line(packet.newest());
    const bool is_list = encoding_ == YarpEncoding::kList;
    text_ += is_list ? "AE (" : "AE " + std::to_string(duration_us) + " \"";
    for (const Event& event : packet.events) {
      const std::uint32_t stamp = stamp_of(packet.time_of(event));
      const bool bit = is_list ? event.polarity == 0 : event.polarity == 1;
      const std::uint32_t address = (bit ? 1U : 0U) | std::uint32_t{event.x} << 1 |
                                    std::uint32_t{event.y} << 12 | (right_eye ? 1U : 0U) << 22;
      if (is_list) {
        if (text_.back() != '(') text_ += ' ';
        text_ += std::to_string(stamp) + ' ' + std::to_string(address);
        continue;
      }
      if (encoding_ == YarpEncoding::kStamped) append_escaped(stamp);
      append_escaped(address);
    }
    text_ += is_list ? ")\n" : "\"\n";
  }

  /// Appends a line of another kind, such as `IMUS (1 2 3)`.
  void add_other(Timestamp time, const std::string& content) {
    begin_line(time);
    text_ += content + '\n';
  }

  const std::string& text() const { return text_; }

 private:
  void begin_line(Timestamp time) {
    char envelope[64];
    std::snprintf(envelope, sizeof envelope, "%d %.6f ", sequence_++,
                  1'569'859'363.0 + static_cast<double>(time - zero_) * 1e-6);
    text_ += envelope;
  }
  std::uint32_t stamp_of(Timestamp time) const {
    const std::int64_t us = time - zero_;
    const std::int64_t ticks = encoding_ == YarpEncoding::kList ? us * 25 / 2 : us;
    return static_cast<std::uint32_t>(first_stamp_ + ticks) & 0x7fffffff;
  }
  void append_escaped(std::uint32_t word) {
    for (int i = 0; i < 4; ++i) {
      const char byte = static_cast<char>(word >> (8 * i) & 0xff);
      switch (byte) {
        case '\n':
          text_ += "\\n";
          break;
        case '\r':
          text_ += "\\r";
          break;
        case '\0':
          text_ += "\\0";
          break;
        case '"':
        case '\\':
          text_ += '\\';
          [[fallthrough]];
        default:
          text_ += byte;
      }
    }
  }

  YarpEncoding encoding_;
  Timestamp zero_;
  std::uint32_t first_stamp_;
  int sequence_ = 19860;
  std::string text_;
};

}  // namespace puck
