#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace puck {

/// Longest channel name in LCM, without its NUL.
inline constexpr std::size_t kMaxChannelName = 63;
/// LCM's header before the channel name of an unfragmented message.
inline constexpr int kLcmHeaderBytes = 8;

/// A datagram that holds one whole message.
struct WholeMessage {
  std::uint32_t number = 0;  ///< Datagrams sent before by this LCM sender; wraps.
  /// 1 to kMaxChannelName bytes, not NUL but otherwise any: print it with printable() only.
  std::string_view channel;
  std::span<const std::uint8_t> payload;  ///< May be empty.
};

/// One part of a message too large for a datagram. Its numbers are consistent with one another and
/// with its length, but not yet checked against the other parts.
struct MessageFragment {
  std::uint32_t number = 0;        ///< The same in all parts of a message.
  std::uint32_t message_size = 0;  ///< Bytes of the whole payload.
  std::uint32_t offset = 0;        ///< Position of this part in the payload, bytes.
  std::uint16_t index = 0;         ///< Index of this part, from 0.
  std::uint16_t fragments = 0;     ///< Number of parts, at least 1.
  std::string_view channel;        ///< As above; empty except in the first part (index 0).
  std::span<const std::uint8_t> payload;
};

/// Not a valid LCM datagram.
struct BadDatagram {
  bool has_magic = false;  ///< Begins with LCM's magic word.
  std::string_view why;    ///< Continues the phrase "the datagram …".
};

using Datagram = std::variant<WholeMessage, MessageFragment, BadDatagram>;

/// Parses a datagram of unknown origin. Reads nothing outside `bytes`, allocates nothing, never
/// throws. The result borrows from `bytes`.
Datagram parse_datagram(std::span<const std::uint8_t> bytes);

/// A name made safe for a terminal, cut after kMaxChannelName bytes: a backslash and bytes that are
/// not printable ASCII become `\xNN`.
std::string printable(std::string_view name);

}  // namespace puck
