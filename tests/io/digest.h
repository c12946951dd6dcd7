#pragma once

#include <array>
#include <charconv>
#include <string>

#include <sodium.h>

#include "common/io/event_reader.h"

namespace puck {

/// What a reader gave: the number of events, and the SHA-256 of a line `t x y p` for each, t in µs.
struct EventDigest {
  std::int64_t events = 0;
  std::string sha256;

  friend bool operator==(const EventDigest&, const EventDigest&) = default;
};

inline EventDigest digest_of(EventReader& reader, std::size_t max_events = 4096) {
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  EventDigest digest;
  EventPacket packet;
  std::string lines;
  while (reader.read(packet, max_events)) {
    lines.clear();
    for (const Event& event : packet.events) {
      std::array<char, 64> line{};
      char* end = std::to_chars(line.data(), line.data() + 24, packet.time_of(event).us).ptr;
      for (const int value : {int{event.x}, int{event.y}, int{event.polarity}}) {
        *end++ = ' ';
        end = std::to_chars(end, end + 8, value).ptr;
      }
      *end++ = '\n';
      lines.append(line.data(), end);
    }
    crypto_hash_sha256_update(&state, reinterpret_cast<const unsigned char*>(lines.data()),
                              lines.size());
    digest.events += static_cast<std::int64_t>(packet.events.size());
  }
  std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
  crypto_hash_sha256_final(&state, hash.data());
  constexpr const char* kDigits = "0123456789abcdef";
  for (const unsigned char byte : hash) {
    digest.sha256 += kDigits[byte >> 4];
    digest.sha256 += kDigits[byte & 0xf];
  }
  return digest;
}

}  // namespace puck
