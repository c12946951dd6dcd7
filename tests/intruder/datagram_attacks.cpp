#include <algorithm>
#include <array>

#include "tests/intruder/attacks.h"

namespace puck {
namespace {

void send_fragment(RawSender& sender, const FragmentHeader& header, std::size_t payload_bytes) {
  Bytes datagram = fragment_header(header);
  if (header.index == 0) {
    append(datagram, sender.name_of(Channel::kEvents));
    datagram.push_back(0);
  }
  append(datagram, sender.random_bytes(payload_bytes));
  sender.send(datagram);
}

/// The first datagram makes LCM's receiver reserve so many bytes; the second one has an offset and
/// length that wrap together in 32 bits, so that it is written before them.
void send_wrapping_pair(RawSender& sender, std::uint32_t number) {
  const std::uint32_t size = 100'000;
  send_fragment(sender, {number, size, 0, 0, 3}, 1000);
  send_fragment(sender, {number, size, 0xffff'ff00, 1, 3}, 1400);
}

}  // namespace

void send_fragments(RawSender& sender, int) {
  const auto number = static_cast<std::uint32_t>(sender.random()());
  send_wrapping_pair(sender, number);
  // Two parts on the same bytes, which leave a hole.
  send_fragment(sender, {number + 1, 2000, 0, 0, 2}, 1000);
  send_fragment(sender, {number + 1, 2000, 500, 1, 2}, 1000);
  // Each gives another size of the same message.
  send_fragment(sender, {number + 2, 3000, 0, 0, 3}, 1000);
  send_fragment(sender, {number + 2, 1000, 0, 1, 2}, 1000);
  // Never complete: 4 GB, 65535 parts, no part, beyond the last.
  send_fragment(sender, {number + 3, 0xffff'ffff, 0, 0, 0xffff}, 1000);
  send_fragment(sender, {number + 4, 0xffff'ffff, 0x8000'0000, 7, 0xffff}, 1000);
  send_fragment(sender, {number + 5, 1000, 0, 0, 0}, 1000);
  send_fragment(sender, {number + 6, 1000, 0, 9, 2}, 1000);
  // Complete with its last part only, which comes twice.
  send_fragment(sender, {number + 7, 1500, 0, 0, 2}, 1000);
  for (int i = 0; i < 2; ++i) send_fragment(sender, {number + 7, 1500, 1000, 1, 2}, 500);
}

void send_endless_names(RawSender& sender, int) {
  const std::string ours = sender.name_of(Channel::kEvents);
  const std::array names{std::string{},
                         ours,
                         std::string(63, 'A'),
                         std::string(64, 'A'),
                         ours + std::string(2000, 'A'),
                         "\x1b[2J" + ours};
  for (const std::string& name : names) {
    for (const bool ends : {false, true}) {
      Bytes datagram = whole_header(0);
      append(datagram, name);
      if (ends) append(datagram, sender.random_bytes(1 + sender.random_below(100)));
      sender.send(datagram);
      // The same name as that of a first fragment.
      datagram = fragment_header({static_cast<std::uint32_t>(sender.random()()), 1000, 0, 0, 2});
      append(datagram, name);
      if (ends) datagram.push_back(0);
      sender.send(datagram);
    }
  }
}

void send_short_headers(RawSender& sender, int) {
  const Bytes whole = whole_header(0);
  const Bytes fragment = fragment_header({1, 1000, 0, 0, 2});
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    sender.send(std::span(whole).first(size));
  }
  for (std::size_t size = 0; size <= fragment.size(); ++size) {
    sender.send(std::span(fragment).first(size));
  }
}

void send_random_datagrams(RawSender& sender, int) {
  constexpr std::size_t kLargest = 65'507;
  const bool is_large = sender.random_below(50) == 0;
  Bytes datagram = sender.random_bytes(sender.random_below(is_large ? kLargest : 1472));
  // Half of them have LCM's magic.
  if (datagram.size() >= 4 && sender.random_below(2) == 0) {
    const Bytes header = sender.random_below(2) == 0 ? whole_header(0) : fragment_header({});
    std::copy_n(header.begin(), 4, datagram.begin());
  }
  sender.send(datagram);
}

}  // namespace puck
