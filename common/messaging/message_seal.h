#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/messaging/shared_key.h"

namespace puck {

/// A seal follows the message: sender, number of the message, keyed hash of all, and four bytes
/// that identify a seal and its version.
inline constexpr std::size_t kSealBytes = 8 + 8 + 16 + 4;

/// Whether a message ends like a sealed one of any version. No proof of origin.
bool looks_sealed(std::span<const std::uint8_t> message);

/// Seals the messages of one publisher. One thread at a time.
class MessageSealer {
 public:
  explicit MessageSealer(const SharedKey& key);

  void seal(std::string_view channel, std::vector<std::uint8_t>& message);

 private:
  const SharedKey& key_;
  std::uint64_t sender_ = 0;  // Random.
  std::uint64_t sealed_ = 0;
};

/// Opens messages sealed with the same key. A repeated message, or one older than the 64 newest of
/// its sender, is refused, so that recordings cannot be replayed while the sender is remembered
/// (the last 256 senders). A new run remembers no sender: an older recording can be replayed to it
/// once. The arm's checks of ages, sessions and clocks then refuse it, except a stop, which always
/// stops. One thread.
class SealOpener {
 public:
  explicit SealOpener(const SharedKey& key) : key_(key) {}

  /// The message without its seal; nothing, with the reason in `problem`, if it is not valid.
  std::optional<std::span<const std::uint8_t>> open(std::string_view channel,
                                                    std::span<const std::uint8_t> message,
                                                    std::string& problem);

 private:
  static constexpr std::size_t kSenders = 256;
  static constexpr std::uint64_t kWindow = 64;

  struct Sender {
    std::uint64_t id = 0;
    std::uint64_t newest = 0;
    std::uint64_t seen = 0;        // Bit i: number newest − i was received.
    std::uint64_t last_heard = 0;  // Value of the message counter; 0: this slot is free.
  };

  bool is_first_time(std::uint64_t id, std::uint64_t number);

  const SharedKey& key_;
  std::array<Sender, kSenders> senders_{};
  std::uint64_t opened_ = 0;
};

}  // namespace puck
