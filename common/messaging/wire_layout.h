#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "common/messaging/channels.h"

namespace puck {

/// Upper limit of times and counts on the wire: sums of two cannot overflow, and doubles are exact.
inline constexpr std::int64_t kMostOnWire = std::int64_t{1} << 53;

enum class WireKind : std::uint8_t { kInt8, kBoolean, kInt32, kInt64, kDouble, kString, kByte };

/// One field of a message as LCM encodes it: big-endian, without padding.
struct WireField {
  std::string_view name;
  WireKind kind{};
  /// Integers: range of values. Strings: range of their lengths. Doubles must be finite, booleans 0
  /// or 1; bytes may have any value.
  std::int64_t min = 0;
  std::int64_t max = 0;
  std::string_view count_field{};  ///< Arrays: the earlier int32 field with the length.
  int fixed_count = 1;             ///< Arrays of fixed length.
  std::span<const std::string_view> meanings{};  ///< Names of the values from 0 on; or empty.
};

/// Encoded bytes of one value; of a string, the minimum: its length and NUL.
std::size_t wire_bytes(WireKind kind);

struct WireLayout {
  std::string_view type;  ///< As in lcmtypes/.
  std::int64_t (*fingerprint)() = nullptr;
  std::span<const WireField> fields;
};

/// The type's fingerprint precedes the fields.
inline constexpr std::size_t kFingerprintBytes = 8;

/// Index of the field with the length of this one; nothing for a fixed length.
std::optional<std::size_t> place_of_count(const WireLayout& layout, const WireField& field);

/// Layout of a channel's messages, from which the receiver's checks follow. Generated from
/// lcmtypes/.
const WireLayout& wire_layout(Channel channel);

/// Largest encoded size of the channel's type.
std::size_t most_message_bytes(Channel channel);

}  // namespace puck
