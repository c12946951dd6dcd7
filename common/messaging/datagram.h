#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace puck {

/// Longest channel name that LCM takes, without its NUL.
inline constexpr std::size_t kMaxChannelName = 63;
/// What LCM itself puts before the name, where a datagram holds one whole message.
inline constexpr int kLcmHeaderBytes = 8;

/// One datagram that holds one whole message.
struct WholeMessage {
  std::uint32_t number = 0;  ///< Datagrams that this sender's LCM sent before; wraps.
  /// 1 to kMaxChannelName bytes, none of them NUL, else anything: printable() before it is shown.
  std::string_view channel;
  std::span<const std::uint8_t> payload;  ///< May be empty.
};

/// One part of a message too large for a datagram. Its numbers agree with one another and with its
/// length; whether they agree with those of the other parts is for whoever puts them together.
struct MessageFragment {
  std::uint32_t number = 0;        ///< The same in all parts of a message.
  std::uint32_t message_size = 0;  ///< Bytes of the whole payload.
  std::uint32_t offset = 0;        ///< Where in it this part belongs.
  std::uint16_t index = 0;         ///< Of this part among them all, from 0.
  std::uint16_t fragments = 0;     ///< Parts of the message; 1 at least.
  std::string_view channel;        ///< As above; only the first part (index 0) has one.
  std::span<const std::uint8_t> payload;
};

/// Not LCM, or LCM that is broken.
struct BadDatagram {
  bool has_magic = false;  ///< Begins as a datagram of LCM does, so somebody meant it for one.
  std::string_view why;    ///< Goes on from "the datagram …".
};

using Datagram = std::variant<WholeMessage, MessageFragment, BadDatagram>;

/// Tells what a datagram is, from its bytes alone, which may come from anybody. Reads nothing
/// outside of them, allocates nothing, never throws. What it returns borrows from them.
Datagram parse_datagram(std::span<const std::uint8_t> bytes);

/// A name fit for a terminal, cut after kMaxChannelName bytes: what is not printable ASCII becomes
/// `\xNN`, and so does a backslash.
std::string printable(std::string_view name);

}  // namespace puck
