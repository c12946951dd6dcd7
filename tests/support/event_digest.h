#pragma once

#include <array>
#include <cstdio>
#include <string>

#include <sodium.h>

#include "common/events/event_packet.h"

namespace puck {

/// SHA-256 of events as lines `t x y p` (t in µs, p 0 or 1, a line feed behind each): what others'
/// decoders are compared with.
class EventDigest {
 public:
  /// `flipped_height`: not 0 for y counted from that row upwards.
  explicit EventDigest(int flipped_height = 0) : flipped_height_(flipped_height) {
    crypto_hash_sha256_init(&state_);
  }

  void add(const EventPacket& packet) {
    for (const Event& event : packet.events) {
      const int y = flipped_height_ > 0 ? flipped_height_ - 1 - event.y : event.y;
      std::array<char, 64> line{};
      const int length = std::snprintf(line.data(), line.size(), "%lld %d %d %d\n",
                                       static_cast<long long>(packet.time_of(event).us),
                                       int{event.x}, y, int{event.polarity});
      crypto_hash_sha256_update(&state_, reinterpret_cast<const unsigned char*>(line.data()),
                                static_cast<unsigned long long>(length));
    }
  }

  /// In hexadecimal; once.
  std::string text() {
    std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
    crypto_hash_sha256_final(&state_, hash.data());
    std::string digits;
    for (const unsigned char byte : hash) {
      std::array<char, 3> pair{};
      std::snprintf(pair.data(), pair.size(), "%02x", byte);
      digits += pair.data();
    }
    return digits;
  }

 private:
  crypto_hash_sha256_state state_{};
  int flipped_height_ = 0;
};

}  // namespace puck
