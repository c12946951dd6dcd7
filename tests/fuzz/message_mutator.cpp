#include "tests/fuzz/message_mutator.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "common/messaging/event_word.h"
#include "common/messaging/wire_layout.h"
#include "tests/support/random_message.h"

namespace puck {
namespace {

constexpr std::size_t kMostElements = 300;

template <typename Container>
auto& any_of(Container& container, std::mt19937_64& random) {
  return container[random() % container.size()];
}

std::int64_t any_whole(const WireField& field, std::mt19937_64& random) {
  // Wraps on purpose: one beyond an end of int64 is the other end.
  const auto plus = [](std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
  };
  const std::array values{field.min,
                          field.max,
                          plus(field.min, -1),
                          plus(field.max, 1),
                          std::int64_t{0},
                          std::int64_t{-1},
                          std::int64_t{std::numeric_limits<std::int32_t>::max()},
                          std::int64_t{std::numeric_limits<std::int32_t>::min()},
                          std::numeric_limits<std::int64_t>::max(),
                          std::numeric_limits<std::int64_t>::min(),
                          static_cast<std::int64_t>(random() % 64),
                          static_cast<std::int64_t>(random())};
  return any_of(values, random);
}

double any_real(std::mt19937_64& random) {
  using Limits = std::numeric_limits<double>;
  const std::array values{0.0,
                          -0.0,
                          1.0,
                          -1.0,
                          1e-300,
                          1e18,
                          -1e18,
                          Limits::max(),
                          Limits::lowest(),
                          Limits::denorm_min(),
                          Limits::infinity(),
                          Limits::quiet_NaN(),
                          std::bit_cast<double>(random())};
  return any_of(values, random);
}

Bytes any_text(std::mt19937_64& random) {
  constexpr std::array<std::size_t, 6> kLengths{0, 1, 20, 254, 255, 256};
  Bytes text(any_of(kLengths, random));
  for (std::uint8_t& c : text) c = static_cast<std::uint8_t>(random() % 95 + 32);
  if (!text.empty() && random() % 4 == 0) any_of(text, random) = random() % 2 == 0 ? 0 : 0x1b;
  constexpr std::array<std::int64_t, 6> kLies{0, -1, -2, 1, 4096, 1LL << 31};
  const std::int64_t lie = random() % 4 == 0 ? any_of(kLies, random) : 0;
  text.push_back(random() % 16 == 0 ? 'x' : 0);
  Bytes value;
  put_big_endian(value, text.size() + static_cast<std::uint64_t>(lie), 4);
  value.insert(value.end(), text.begin(), text.end());
  return value;
}

Bytes any_value(const WireField& field, std::mt19937_64& random) {
  Bytes value;
  switch (field.kind) {
    case WireKind::kString:
      return any_text(random);
    case WireKind::kDouble:
      put_big_endian(value, std::bit_cast<std::uint64_t>(any_real(random)), 8);
      break;
    case WireKind::kInt64:
      put_big_endian(value, static_cast<std::uint64_t>(any_whole(field, random)), 8);
      break;
    case WireKind::kInt32:
      put_big_endian(value, static_cast<std::uint64_t>(any_whole(field, random)), 4);
      break;
    case WireKind::kInt8:
    case WireKind::kBoolean:
    case WireKind::kByte:
      put_big_endian(value, static_cast<std::uint64_t>(any_whole(field, random)), 1);
      break;
  }
  return value;
}

/// Sensors, encodings and times of every kind, and mostly events that fit them.
Bytes any_events(std::mt19937_64& random) {
  event_packet_t packet{};
  packet.session = 1;
  packet.width = static_cast<std::int32_t>(random() % 2048 + 1);
  packet.height = static_cast<std::int32_t>(random() % 2048 + 1);
  packet.encoding =
      random() % 8 == 0
          ? static_cast<std::int32_t>(random() % 3 + 1)
          : encoding_for({static_cast<int>(packet.width), static_cast<int>(packet.height)});
  packet.first_event_us = static_cast<std::int64_t>(random() >> 11);
  packet.count = static_cast<std::int32_t>(random() % kMostElements);
  packet.data.resize(static_cast<std::size_t>(4 * packet.count));
  with_event_word(packet.encoding, [&](auto word) {
    using Word = decltype(word);
    std::uint32_t dt_us = 0;
    for (std::size_t i = 0; i < packet.data.size(); i += 4) {
      dt_us = std::min<std::uint32_t>(dt_us + random() % 8, Word::kMaxDtUs);
      store_event_word(
          &packet.data[i],
          Word::pack(static_cast<std::uint32_t>(random() % packet.width),
                     static_cast<std::uint32_t>(random() % packet.height), random() & 1, dt_us));
    }
    packet.duration_us = dt_us;
  });
  Bytes bytes;
  encode(packet, bytes);
  return bytes;
}

Bytes any_message(Channel channel, std::mt19937_64& random) {
  if (channel == Channel::kEvents && random() % 4 != 0) return any_events(random);
  return random_message(channel, random).bytes;
}

void change_value(std::vector<MessagePart>& parts, std::mt19937_64& random) {
  MessagePart& part = any_of(parts, random);
  if (part.values.empty()) return;
  Bytes& value = any_of(part.values, random);
  if (part.field->kind != WireKind::kByte) {
    value = any_value(*part.field, random);
  } else if (!value.empty()) {
    any_of(value, random) ^= static_cast<std::uint8_t>(1U << random() % 8);
  }
}

void change_length(const WireLayout& layout, std::vector<MessagePart>& parts,
                   std::mt19937_64& random) {
  std::vector<MessagePart*> counts;
  for (MessagePart& part : parts) {
    if (is_count(layout, *part.field)) counts.push_back(&part);
  }
  if (counts.empty()) return;
  const MessagePart& count = *any_of(counts, random);
  const auto most = static_cast<std::size_t>(count.field->max);
  const std::array<std::size_t, 5> lengths{0, 1, most, most + 1, random() % kMostElements};
  set_length(parts, count, any_of(lengths, random));
}

void change_bytes(Bytes& message, std::size_t from, MutateBytes mutate_bytes) {
  constexpr std::size_t kGrowth = 64;
  if (message.size() < from) return;
  const std::size_t size = message.size() - from;
  message.resize(message.size() + kGrowth);
  message.resize(from + mutate_bytes(message.data() + from, size, size + kGrowth));
}

}  // namespace

Bytes mutate_message(Channel channel, std::span<const std::uint8_t> message,
                     std::mt19937_64& random, MutateBytes mutate_bytes) {
  const WireLayout& layout = wire_layout(channel);
  Bytes changed(message.begin(), message.end());
  if (changed.size() < kFingerprintBytes || random() % 16 == 0) return any_message(channel, random);
  switch (random() % 8) {
    case 0:
      change_bytes(changed, 0, mutate_bytes);
      return changed;
    case 1:
      change_bytes(changed, kFingerprintBytes, mutate_bytes);
      return changed;
    case 2:
      changed.resize(random() % (changed.size() + 16));
      return changed;
    default:
      break;
  }
  std::vector<MessagePart> parts = parts_of(layout, message);
  if (random() % 4 == 0) {
    change_length(layout, parts, random);
  } else {
    for (std::uint64_t i = 0; i <= random() % 3; ++i) change_value(parts, random);
  }
  return message_of(layout, parts);
}

}  // namespace puck
