#include "tests/support/random_message.h"

#include <algorithm>
#include <bit>
#include <map>

#include "common/messaging/event_packing.h"
#include "common/messaging/wire_layout.h"

namespace puck {
namespace {

class Writer {
 public:
  Writer(const WireLayout& layout, std::mt19937_64& random) : layout_(layout), random_(random) {
    put(static_cast<std::uint64_t>(layout.fingerprint()), 8);
    for (const WireField& field : layout.fields) put_field(field);
  }

  RandomMessage message;

 private:
  std::int64_t between(std::int64_t min, std::int64_t max) {
    return std::uniform_int_distribution<std::int64_t>(min, max)(random_);
  }

  void put(std::uint64_t value, int bytes) {
    for (int i = bytes - 1; i >= 0; --i) {
      message.bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
  }

  bool is_count(std::string_view name) const {
    return std::any_of(layout_.fields.begin(), layout_.fields.end(),
                       [&](const WireField& field) { return field.count_field == name; });
  }

  void put_field(const WireField& field) {
    const std::int64_t count =
        field.count_field.empty() ? field.fixed_count : counts_.at(field.count_field);
    for (std::int64_t i = 0; i < count; ++i) put_value(field);
  }

  void put_value(const WireField& field) {
    switch (field.kind) {
      case WireKind::kString: {
        const auto length = between(0, 20);
        put(static_cast<std::uint64_t>(length + 1), 4);
        for (std::int64_t i = 0; i < length; ++i)
          put(static_cast<std::uint64_t>(between(32, 126)), 1);
        return put(0, 1);
      }
      case WireKind::kDouble:
        return put(
            std::bit_cast<std::uint64_t>(std::uniform_real_distribution<>(-1e6, 1e6)(random_)), 8);
      case WireKind::kInt8:
      case WireKind::kBoolean:
      case WireKind::kByte:
        return put(static_cast<std::uint64_t>(between(field.min, field.max)), 1);
      case WireKind::kInt64:
        return put(static_cast<std::uint64_t>(between(field.min, field.max)), 8);
      case WireKind::kInt32: {
        std::int64_t value = between(field.min, field.max);
        if (is_count(field.name)) {
          value = between(0, 5);
          counts_[field.name] = value;
          message.count_offsets.push_back(message.bytes.size());
        }
        return put(static_cast<std::uint64_t>(value), 4);
      }
    }
  }

  const WireLayout& layout_;
  std::mt19937_64& random_;
  std::map<std::string_view, std::int64_t> counts_;
};

RandomMessage random_events(std::mt19937_64& random) {
  std::vector<Event> events(random() % 50 + 1);
  std::uint32_t time_us = 0;
  for (Event& event : events) {
    time_us += static_cast<std::uint32_t>(random() % 20);
    event.x = static_cast<std::uint16_t>(random() % 640);
    event.y = static_cast<std::uint16_t>(random() % 480);
    event.polarity = random() & 1;
    event.offset_us = time_us;
  }
  RandomMessage message;
  EventPacker packer({.sensor = {640, 480}});
  packer.pack({1'000'000}, events, [&](event_packet_t& packet) {
    packet.session = 1;
    encode(packet, message.bytes);
  });
  // count and size precede the data.
  const std::size_t data_bytes = 4 * events.size();
  message.count_offsets = {message.bytes.size() - data_bytes - 8,
                           message.bytes.size() - data_bytes - 4};
  return message;
}

}  // namespace

RandomMessage random_structure(Channel channel, std::mt19937_64& random) {
  return Writer(wire_layout(channel), random).message;
}

RandomMessage random_message(Channel channel, std::mt19937_64& random) {
  return channel == Channel::kEvents ? random_events(random) : random_structure(channel, random);
}

}  // namespace puck
