#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "common/messaging/channels.h"

namespace puck {

/// The most that a time or a count may be on the wire: beyond it, sums of two could overflow, and a
/// double would no longer have every µs.
inline constexpr std::int64_t kMostOnWire = std::int64_t{1} << 53;

enum class WireKind : std::uint8_t { kInt8, kBoolean, kInt32, kInt64, kDouble, kString, kByte };

/// One field of a message as LCM writes it: big-endian, one after the other.
struct WireField {
  std::string_view name;
  WireKind kind{};
  /// Of whole numbers: the values allowed. Of a string: the characters. Doubles must be finite,
  /// booleans 0 or 1, bytes may be anything.
  std::int64_t min = 0;
  std::int64_t max = 0;
  std::string_view count_field{};  ///< Of an array: the int32 field before it that has its length.
  int fixed_count = 1;             ///< Of an array of fixed length.
  std::span<const std::string_view> meanings{};  ///< What the values from 0 on are called, if so.
};

/// Encoded, one value; of a string the least: its length and its NUL.
std::size_t wire_bytes(WireKind kind);

struct WireLayout {
  std::string_view type;  ///< As in lcmtypes/.
  std::int64_t (*fingerprint)() = nullptr;
  std::span<const WireField> fields;
};

/// Before the fields stands what tells the type.
inline constexpr std::size_t kFingerprintBytes = 8;

/// Which field of the layout has the length of this one; nothing where that is fixed.
std::optional<std::size_t> place_of_count(const WireLayout& layout, const WireField& field);

/// How a channel's messages look: what the receiver's checks are made from. A new type needs a row
/// here and nothing else to be received safely.
const WireLayout& wire_layout(Channel channel);

/// The most that a message of the channel's type may have, encoded.
std::size_t most_message_bytes(Channel channel);

}  // namespace puck
