// Any datagram: all parts of the result lie within it.
#include <algorithm>
#include <variant>

#include "common/messaging/datagram.h"
#include "tests/fuzz/message_parts.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

void put_channel(Bytes& bytes, std::string_view channel) {
  bytes.insert(bytes.end(), channel.begin(), channel.end());
  bytes.push_back(0);
}

Bytes datagram_of(const WholeMessage& message) {
  Bytes bytes{'L', 'C', '0', '2'};
  put_big_endian(bytes, message.number, 4);
  put_channel(bytes, message.channel);
  bytes.insert(bytes.end(), message.payload.begin(), message.payload.end());
  return bytes;
}

Bytes datagram_of(const MessageFragment& fragment) {
  Bytes bytes{'L', 'C', '0', '3'};
  put_big_endian(bytes, fragment.number, 4);
  put_big_endian(bytes, fragment.message_size, 4);
  put_big_endian(bytes, fragment.offset, 4);
  put_big_endian(bytes, fragment.index, 2);
  put_big_endian(bytes, fragment.fragments, 2);
  if (fragment.index == 0) put_channel(bytes, fragment.channel);
  bytes.insert(bytes.end(), fragment.payload.begin(), fragment.payload.end());
  return bytes;
}

template <typename Message>
void check(const Message& message, std::span<const std::uint8_t> datagram) {
  require(message.channel.size() <= kMaxChannelName, "channel names are short");
  require_one_line("channel " + printable(message.channel));
  const Bytes again = datagram_of(message);
  require(std::equal(again.begin(), again.end(), datagram.begin(), datagram.end()),
          "what was read of a datagram makes it again");
}

void check(const MessageFragment& fragment, std::span<const std::uint8_t> datagram) {
  check<MessageFragment>(fragment, datagram);
  require(fragment.payload.size() <= fragment.message_size &&
              fragment.offset <= fragment.message_size - fragment.payload.size(),
          "a fragment lies inside its message");
  require(fragment.index < fragment.fragments, "a fragment is one of its message's");
}

void check(const BadDatagram& bad, std::span<const std::uint8_t> datagram) {
  require_one_line(bad.why);
  const bool has_magic = datagram.size() >= 4 && datagram[0] == 'L' && datagram[1] == 'C' &&
                         datagram[2] == '0' && (datagram[3] == '2' || datagram[3] == '3');
  require(bad.has_magic == has_magic, "a datagram that was meant for LCM is told of as such");
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> datagram(data, size);
  std::visit([&](const auto& what) { puck::check(what, datagram); },
             puck::parse_datagram(datagram));
  return 0;
}
