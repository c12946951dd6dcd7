#include "common/messaging/message_check.h"

#include <array>
#include <cmath>
#include <string_view>

#include "common/messaging/byte_reader.h"
#include "common/messaging/event_packet_view.h"
#include "common/messaging/event_word.h"
#include "common/messaging/wire_layout.h"

namespace puck {
namespace {

using Rejection = std::optional<std::string>;

constexpr std::size_t kMaxMessageBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxFields = 64;

/// Explains an unexpected fingerprint.
std::string name_of_other(std::int64_t fingerprint) {
  for (const Channel channel : kAllChannels) {
    const WireLayout& layout = wire_layout(channel);
    if (layout.fingerprint() == fingerprint) {
      return "is expected, but this is " + std::string(layout.type);
    }
  }
  return "has the fingerprint of another type or version";
}

/// Checks one message against its layout.
class Walk {
 public:
  Walk(const WireLayout& layout, std::span<const std::uint8_t> bytes)
      : layout_(layout), reader_(bytes) {}

  Rejection run() {
    if (reader_.left() > kMaxMessageBytes) return rejection("is too large");
    if (!reader_.has(kFingerprintBytes)) return rejection("is cut off before its fingerprint");
    const auto fingerprint = reader_.whole<std::int64_t>();
    if (fingerprint != layout_.fingerprint()) return rejection(name_of_other(fingerprint));
    for (std::size_t i = 0; i < layout_.fields.size(); ++i) {
      if (auto bad = check_field(i)) return bad;
    }
    if (reader_.left() != 0) {
      return rejection("has " + std::to_string(reader_.left()) + " bytes too many");
    }
    return std::nullopt;
  }

 private:
  Rejection check_field(std::size_t index) {
    const WireField& field = layout_.fields[index];
    const std::size_t count = count_of(field);
    // Counts and sizes were bounded when they were read, so the product cannot wrap.
    if (!reader_.has(count * wire_bytes(field.kind))) return rejection(field, "is cut off");
    if (field.kind == WireKind::kByte) {
      reader_.take(count);
      return std::nullopt;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (auto bad = check_value(field, values_[index])) return bad;
    }
    return std::nullopt;
  }

  std::size_t count_of(const WireField& field) const {
    const auto place = place_of_count(layout_, field);
    return static_cast<std::size_t>(place ? values_[*place] : field.fixed_count);
  }

  Rejection check_value(const WireField& field, std::int64_t& value) {
    switch (field.kind) {
      case WireKind::kDouble:
        if (!std::isfinite(reader_.real())) return rejection(field, "is not a finite number");
        return std::nullopt;
      case WireKind::kString:
        return check_text(field);
      case WireKind::kInt8:
      case WireKind::kBoolean:
        value = reader_.whole<std::int8_t>();
        break;
      case WireKind::kInt32:
        value = reader_.whole<std::int32_t>();
        break;
      case WireKind::kInt64:
        value = reader_.whole<std::int64_t>();
        break;
      case WireKind::kByte:
        break;
    }
    if (value < field.min || value > field.max) {
      return rejection(field, "must be " + std::to_string(field.min) + " to " +
                                  std::to_string(field.max) + ", got " + std::to_string(value));
    }
    return std::nullopt;
  }

  Rejection check_text(const WireField& field) {
    if (!reader_.has(4)) return rejection(field, "is cut off");
    const std::int64_t length = reader_.whole<std::int32_t>();  // Includes the NUL.
    if (length < 1 || length - 1 > field.max) {
      return rejection(field, "has a length of " + std::to_string(length));
    }
    if (!reader_.has(static_cast<std::size_t>(length))) return rejection(field, "is cut off");
    const auto text = reader_.take(static_cast<std::size_t>(length));
    if (text.back() != 0) return rejection(field, "does not end");
    for (const std::uint8_t c : text.first(text.size() - 1)) {
      // Control characters would reach a terminal.
      if (c < 0x20 || c == 0x7f) return rejection(field, "has a control character");
    }
    return std::nullopt;
  }

  std::string rejection(std::string_view what) const {
    return std::string(layout_.type) + " " + std::string(what);
  }
  std::string rejection(const WireField& field, std::string_view what) const {
    return std::string(layout_.type) + "." + std::string(field.name) + " " + std::string(what);
  }

  const WireLayout& layout_;
  ByteReader reader_;
  std::array<std::int64_t, kMaxFields> values_{};
};

EventPacketView view_of_events(std::span<const std::uint8_t> bytes) {
  EventPacketView packet;
  decode_checked(bytes, packet);
  return packet;
}

template <typename Word>
Rejection check_event_words(const EventPacketView& packet, Word) {
  // Signed, since every vector unit compares signed numbers; no field reaches the sign bit.
  const std::int32_t width = packet.width;
  const std::int32_t height = packet.height;
  const auto count = static_cast<std::size_t>(packet.count);
  const auto dt_us = [&](std::size_t i) {
    return static_cast<std::int32_t>(Word::dt_us(load_event_word(packet.data.data() + 4 * i)));
  };
  // Accumulates errors without branches or dependences between events, so that compilers vectorise
  // the loops.
  std::int32_t outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t word = load_event_word(packet.data.data() + 4 * i);
    outside |= static_cast<std::int32_t>(static_cast<std::int32_t>(Word::x(word)) >= width) |
               static_cast<std::int32_t>(static_cast<std::int32_t>(Word::y(word)) >= height);
  }
  std::int32_t backwards = 0;
  for (std::size_t i = 1; i < count; ++i) {
    backwards |= static_cast<std::int32_t>(dt_us(i) < dt_us(i - 1));
  }
  if (outside != 0) return "event_packet_t has an event outside its sensor";
  if (backwards != 0) return "event_packet_t has events that go back in time";
  if (count > 0 && dt_us(count - 1) > packet.duration_us) {
    return "event_packet_t has an event after its duration";
  }
  return std::nullopt;
}

Rejection check_events(const EventPacketView& packet) {
  if (packet.size != 4 * packet.count) {
    return "event_packet_t.size must be 4 * count = " + std::to_string(4 * packet.count) +
           ", got " + std::to_string(packet.size);
  }
  return with_event_word(packet.encoding, [&](auto word) -> Rejection {
    using Word = decltype(word);
    if (packet.width > 1 << Word::kXBits || packet.height > 1 << Word::kYBits) {
      return "event_packet_t has a sensor too large for its encoding";
    }
    return check_event_words(packet, word);
  });
}

}  // namespace

std::optional<std::string> check_message(Channel channel, std::span<const std::uint8_t> bytes) {
  if (auto bad = Walk(wire_layout(channel), bytes).run()) return bad;
  if (channel == Channel::kEvents) return check_events(view_of_events(bytes));
  return std::nullopt;
}

MessageHeader read_header(std::span<const std::uint8_t> bytes) {
  ByteReader reader(bytes);
  reader.take(kFingerprintBytes);
  MessageHeader header;
  header.utime = reader.whole<std::int64_t>();
  header.session = reader.whole<std::int64_t>();
  header.seq = reader.whole<std::int64_t>();
  return header;
}

EventNumbering read_event_numbering(std::span<const std::uint8_t> bytes) {
  const EventPacketView packet = view_of_events(bytes);
  return {packet.events_before, packet.count};
}

}  // namespace puck
