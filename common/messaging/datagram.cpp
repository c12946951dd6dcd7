#include "common/messaging/datagram.h"

#include <algorithm>
#include <optional>

#include "common/messaging/byte_reader.h"

namespace puck {
namespace {

constexpr std::uint32_t kWholeMagic = 0x4c433032;     // "LC02"
constexpr std::uint32_t kFragmentMagic = 0x4c433033;  // "LC03"
constexpr std::size_t kMagicBytes = 4;
constexpr std::size_t kWholeHeaderBytes = 8;
constexpr std::size_t kFragmentHeaderBytes = 20;

/// Reads a 16-bit big-endian number of a fragment's header.
std::uint16_t short_number(ByteReader& reader) {
  const auto bytes = reader.take(2);
  return static_cast<std::uint16_t>(bytes[0] << 8 | bytes[1]);
}

/// Reads the channel name with its NUL; returns an error or nothing.
std::optional<std::string_view> take_channel(ByteReader& reader, std::string_view& channel) {
  const auto rest = reader.rest().first(std::min(reader.left(), kMaxChannelName + 1));
  const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{0});
  if (end == rest.end()) {
    return rest.size() > kMaxChannelName ? "has a channel name of more than 63 bytes"
                                         : "has an unterminated channel name";
  }
  if (end == rest.begin()) return "has no channel name";
  const auto length = static_cast<std::size_t>(end - rest.begin());
  const auto name = reader.take(length + 1).first(length);
  channel = {reinterpret_cast<const char*>(name.data()), name.size()};
  return std::nullopt;
}

Datagram parse_whole(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kWholeHeaderBytes) return BadDatagram{true, "is shorter than its header"};
  ByteReader reader(bytes.subspan(kMagicBytes));
  WholeMessage message;
  message.number = reader.whole<std::uint32_t>();
  if (const auto bad = take_channel(reader, message.channel)) return BadDatagram{true, *bad};
  message.payload = reader.rest();
  return message;
}

Datagram parse_fragment(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kFragmentHeaderBytes) return BadDatagram{true, "is shorter than its header"};
  ByteReader reader(bytes.subspan(kMagicBytes));
  MessageFragment fragment;
  fragment.number = reader.whole<std::uint32_t>();
  fragment.message_size = reader.whole<std::uint32_t>();
  fragment.offset = reader.whole<std::uint32_t>();
  fragment.index = short_number(reader);
  fragment.fragments = short_number(reader);
  if (fragment.index >= fragment.fragments) {
    return BadDatagram{true, "is a fragment numbered beyond the last one"};
  }
  if (fragment.index == 0) {
    if (const auto bad = take_channel(reader, fragment.channel)) return BadDatagram{true, *bad};
  }
  fragment.payload = reader.rest();
  // In 64 bits: in LCM's 32 bits this sum wraps, which crashes its receivers.
  if (std::uint64_t{fragment.offset} + fragment.payload.size() > fragment.message_size) {
    return BadDatagram{true, "is a fragment that reaches beyond its message"};
  }
  return fragment;
}

bool is_printable(char c) { return c >= 0x20 && c < 0x7f && c != '\\'; }

}  // namespace

Datagram parse_datagram(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kMagicBytes) return BadDatagram{false, "is too short to be one of LCM"};
  switch (ByteReader(bytes).whole<std::uint32_t>()) {
    case kWholeMagic:
      return parse_whole(bytes);
    case kFragmentMagic:
      return parse_fragment(bytes);
    default:
      return BadDatagram{false, "is not one of LCM"};
  }
}

std::string printable(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : name.substr(0, kMaxChannelName)) {
    if (is_printable(c)) {
      text += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    text += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return text;
}

}  // namespace puck
