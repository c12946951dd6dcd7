#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "common/messaging/wire_layout.h"
#include "tests/intruder/attacks.h"
#include "tests/support/random_message.h"

namespace puck {
namespace {

void overwrite(Bytes& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * (size - 1 - i)));
  }
}

Channel random_channel(RawSender& sender) {
  return kAllChannels[sender.random_below(kAllChannels.size())];
}

void send_with_value(RawSender& sender, Channel channel, std::size_t at, std::uint64_t value,
                     std::size_t size) {
  Bytes bytes = random_message(channel, sender.random()).bytes;
  overwrite(bytes, at, value, size);
  sender.send_message(channel, bytes);
}

/// With a session of its own, unlike those of the game's services.
template <typename Message>
void send_numbered(RawSender& sender, Channel channel, Message message, std::int64_t seq) {
  Bytes bytes = random_message(channel, sender.random()).bytes;
  decode_checked(bytes, message);
  message.session = std::numeric_limits<std::int64_t>::max();
  message.seq = seq;
  encode(message, bytes);
  sender.send_message(channel, bytes);
}

}  // namespace

void send_wrong_counts(RawSender& sender, int) {
  for (const Channel channel : kAllChannels) {
    const RandomMessage good = random_message(channel, sender.random());
    for (const std::size_t at : good.count_offsets) {
      for (const std::uint32_t count : {0x7fff'ffffU, 0xffff'ffffU, 0x8000'0000U, 0x2000'0000U}) {
        Bytes bytes = good.bytes;
        overwrite(bytes, at, count, 4);
        sender.send_message(channel, bytes);
      }
    }
  }
}

void send_random_payloads(RawSender& sender, int) {
  for (const Channel channel : kAllChannels) {
    const Bytes good = random_message(channel, sender.random()).bytes;
    sender.send_message(channel, {});
    sender.send_message(channel, sender.random_bytes(1 + sender.random_below(1400)));
    sender.send_message(channel, std::span(good).first(sender.random_below(good.size())));
    Bytes bytes = good;
    bytes.push_back(0);
    sender.send_message(channel, bytes);
    // After the right fingerprint, too few bytes for the smallest type.
    bytes.resize(kFingerprintBytes);
    append(bytes, sender.random_bytes(sender.random_below(20)));
    sender.send_message(channel, bytes);
  }
}

void send_wrong_fingerprints(RawSender& sender, int) {
  for (const Channel channel : kAllChannels) {
    Bytes bytes = random_message(channel, sender.random()).bytes;
    bytes[sender.random_below(kFingerprintBytes)] ^= 0x40;
    sender.send_message(channel, bytes);
    for (const Channel other : kAllChannels) {
      if (other == channel) continue;
      sender.send_message(channel, random_message(other, sender.random()).bytes);
    }
  }
}

void send_impossible_values(RawSender& sender, int) {
  constexpr std::size_t kSessionAt = kFingerprintBytes + 8;
  constexpr std::size_t kSeqAt = kSessionAt + 8;
  constexpr std::size_t kSizeAt = kSeqAt + 8;  // EVENTS: the sensor's width and height.
  for (const Channel channel : kAllChannels) {
    send_with_value(sender, channel, kSessionAt, 0, 8);
    send_with_value(sender, channel, kSeqAt, ~std::uint64_t{0}, 8);
  }
  for (const std::uint32_t width : {0U, 1U, 0x7fff'ffffU, 0xffff'ffffU}) {
    send_with_value(sender, Channel::kEvents, kSizeAt, width, 4);
  }
  const std::array reals{std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity()};
  // Types with fields at fixed offsets: every real number in turn.
  for (const Channel channel : {Channel::kEstimate, Channel::kArmCommand, Channel::kTruth}) {
    std::size_t at = kFingerprintBytes;
    for (const WireField& field : wire_layout(channel).fields) {
      const bool is_real = field.kind == WireKind::kDouble;
      const bool is_long = is_real || field.kind == WireKind::kInt64;
      const std::size_t size = is_long ? 8 : field.kind == WireKind::kInt32 ? 4 : 1;
      if (is_real) {
        for (const double real : reals) {
          send_with_value(sender, channel, at, std::bit_cast<std::uint64_t>(real), 8);
        }
      }
      at += size * static_cast<std::size_t>(field.fixed_count);
    }
  }
}

void send_many_channels(RawSender& sender, int round) {
  // With another seed other names.
  constexpr int kNames = 20'000;
  const std::string name = (sender.prefix().empty() ? "" : sender.prefix() + "_") + "PUCK_" +
                           std::to_string(sender.seed()) + "_" + std::to_string(round % kNames);
  sender.send_message(name, random_message(Channel::kGame, sender.random()).bytes);
}

void send_time_travel(RawSender& sender, int round) {
  constexpr std::int64_t kFar = std::int64_t{1} << 53;
  const std::int64_t now = round;
  for (const std::int64_t seq :
       {now, now, now > 5 ? now - 5 : 0, now + 50, kFar, std::int64_t{0}}) {
    const Channel channel = random_channel(sender);
    with_message_type(channel, [&](auto message) { send_numbered(sender, channel, message, seq); });
  }
}

void send_flood(RawSender& sender, int round) {
  // 60 kB now and then: enough to fill every queue with.
  const std::size_t size = round % 8 == 0 ? 60'000 : 8;
  sender.send_message(random_channel(sender), Bytes(size, 0xff));
}

}  // namespace puck
