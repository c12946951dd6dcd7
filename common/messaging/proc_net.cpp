#include "common/messaging/proc_net.h"

#include <charconv>
#include <sstream>

#include "common/messaging/ipv4.h"

namespace puck {
namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

template <typename Number>
std::optional<Number> number_of(std::string_view text, int base) {
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The kernel prints an address as an integer in this machine's byte order.
std::optional<std::string> address_of(std::string_view hex) {
  const auto number = number_of<std::uint32_t>(hex, 16);
  if (!number) return std::nullopt;
  return dotted({*number});
}

}  // namespace

std::vector<GroupMembership> parse_memberships(std::string_view igmp) {
  std::vector<GroupMembership> memberships;
  std::string interface;
  for (const std::string& line : lines_of(igmp)) {
    const auto words = words_of(line);
    if (words.size() < 2) continue;
    const bool is_interface = line.front() != '\t' && line.front() != ' ';
    if (is_interface) {
      interface = words[1];
      continue;
    }
    const auto group = address_of(words[0]);
    const auto users = number_of<int>(words[1], 10);
    if (group && users) memberships.push_back({interface, *group, *users});
  }
  return memberships;
}

std::vector<UdpSocket> parse_udp_sockets(std::string_view udp) {
  constexpr std::size_t kLocal = 1;
  constexpr std::size_t kInode = 9;
  std::vector<UdpSocket> sockets;
  for (const std::string& line : lines_of(udp)) {
    const auto words = words_of(line);
    if (words.size() <= kInode) continue;
    const std::string_view local = words[kLocal];
    const auto colon = local.find(':');
    if (colon == std::string_view::npos) continue;
    const auto address = address_of(local.substr(0, colon));
    const auto port = number_of<int>(local.substr(colon + 1), 16);
    const auto inode = number_of<std::uint64_t>(words[kInode], 10);
    if (address && port && inode) sockets.push_back({*address, *port, *inode});
  }
  return sockets;
}

std::optional<std::int64_t> find_counter(std::string_view snmp, std::string_view protocol,
                                         std::string_view name) {
  // Two lines for each protocol: names, then values in the same order.
  const std::string begin = std::string(protocol) + ":";
  std::vector<std::string> names;
  for (const std::string& line : lines_of(snmp)) {
    auto words = words_of(line);
    if (words.empty() || words[0] != begin) continue;
    if (names.empty()) {
      names = std::move(words);
      continue;
    }
    for (std::size_t i = 1; i < names.size() && i < words.size(); ++i) {
      if (names[i] == name) return number_of<std::int64_t>(words[i], 10);
    }
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace puck
