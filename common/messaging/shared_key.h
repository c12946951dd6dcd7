#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace puck {

/// A secret that all machines of one robot have in a file, and a keyed hash (BLAKE2b) made with it.
class SharedKey {
 public:
  using Hash = std::array<std::uint8_t, 16>;

  /// The file has at least 32 bytes, best from /dev/urandom, and belongs to its owner alone (mode
  /// 0600 or less). Throws BusError, naming lcm.key_file and what mends it.
  explicit SharedKey(const std::filesystem::path& file);

  /// Of a message on a channel with its number; equal only for the same of all four.
  Hash hash(std::string_view channel, std::span<const std::uint8_t> message, std::uint64_t sender,
            std::uint64_t number) const;

 private:
  std::array<std::uint8_t, 32> key_{};
};

}  // namespace puck
