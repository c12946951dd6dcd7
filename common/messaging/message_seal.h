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

/// What a seal adds behind a message: who sealed it, the how manieth of theirs it is, the keyed
/// hash of all of it, and four bytes that tell a sealed message and the version of its seal.
inline constexpr std::size_t kSealBytes = 8 + 8 + 16 + 4;

/// Whether a message ends as a sealed one does, of whatever version. It proves nothing.
bool looks_sealed(std::span<const std::uint8_t> message);

/// Seals what one publisher sends. One thread at a time.
class MessageSealer {
 public:
  explicit MessageSealer(const SharedKey& key);

  void seal(std::string_view channel, std::vector<std::uint8_t>& message);

 private:
  const SharedKey& key_;
  std::uint64_t sender_ = 0;  // Random.
  std::uint64_t sealed_ = 0;
};

/// Opens what others have sealed with the same key. A message is good once: the same again, or one
/// older than the 64 newest of its sender, is refused, so that nobody can play back what they heard
/// while its sender lives in here (the last 256 senders). A new run knows no sender: what was
/// recorded before it can be played to it once, and is left to the ages, sessions and clocks that
/// the arm goes by; a stop has none of these, and stops. One thread.
class SealOpener {
 public:
  explicit SealOpener(const SharedKey& key) : key_(key) {}

  /// The message without its seal; nothing, and `problem` says why, when it is not good.
  std::optional<std::span<const std::uint8_t>> open(std::string_view channel,
                                                    std::span<const std::uint8_t> message,
                                                    std::string& problem);

 private:
  static constexpr std::size_t kSenders = 256;
  static constexpr std::uint64_t kWindow = 64;

  struct Sender {
    std::uint64_t id = 0;
    std::uint64_t newest = 0;
    std::uint64_t seen = 0;        // Bit i: number newest − i has come.
    std::uint64_t last_heard = 0;  // Messages opened by then; 0: this place is free.
  };

  bool is_first_time(std::uint64_t id, std::uint64_t number);

  const SharedKey& key_;
  std::array<Sender, kSenders> senders_{};
  std::uint64_t opened_ = 0;
};

}  // namespace puck
