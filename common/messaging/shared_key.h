#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace puck {

/// A secret that all machines of one robot have in a file, and a keyed hash made with it: Poly1305
/// with a key for each message, which HChaCha20 makes of the secret, the sender and the number.
class SharedKey {
 public:
  using Hash = std::array<std::uint8_t, 16>;

  /// The file has at least 32 bytes, best from /dev/urandom, and belongs to its owner alone (mode
  /// 0600 or less). Throws BusError, naming lcm.key_file and what mends it.
  explicit SharedKey(const std::filesystem::path& file);

  /// Of a message on a channel with its number; equal only for the same of all four. No sender may
  /// use a number twice for two messages that others see: the key of that number would be known.
  /// So a sender is 64 random bits of each Bus, which counts its messages. A copy of a process
  /// that runs on (a fork, a virtual machine's snapshot started twice) has the same sender and
  /// number, and would.
  Hash hash(std::string_view channel, std::span<const std::uint8_t> message, std::uint64_t sender,
            std::uint64_t number) const;

 private:
  std::array<std::uint8_t, 32> key_{};
};

}  // namespace puck
