#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace puck {

/// A secret in a file on all machines of one robot, and a keyed hash: Poly1305 with a key for each
/// message, derived by HChaCha20 from the secret, the sender and the number.
class SharedKey {
 public:
  using Hash = std::array<std::uint8_t, 16>;

  /// The file must have at least 32 bytes, best from /dev/urandom, and be readable by its owner
  /// only (mode 0600 or less). Throws BusError that names lcm.key_file and the remedy.
  explicit SharedKey(const std::filesystem::path& file);

  /// Hash of a message, its channel, sender and number; equal only if all four are equal. A sender
  /// must never use a number for two published messages, since that reveals the number's key. A
  /// sender is therefore 64 random bits of each Bus, which counts its messages. Copies of a running
  /// process (a fork, a virtual machine's snapshot started twice) share sender and number, and
  /// break this rule.
  Hash hash(std::string_view channel, std::span<const std::uint8_t> message, std::uint64_t sender,
            std::uint64_t number) const;

 private:
  std::array<std::uint8_t, 32> key_{};
};

}  // namespace puck
