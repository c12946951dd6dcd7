#include "common/messaging/channels.h"

#include <algorithm>

#include "common/messaging/bus_error.h"

namespace puck {

std::string channel_name(Channel channel, std::string_view prefix) {
  std::string name(prefix);
  if (!name.empty()) name += '_';
  return name.append(base_name(channel));
}

std::string channel_beginning(std::string_view prefix) {
  return std::string(prefix) + (prefix.empty() ? "PUCK_" : "_PUCK_");
}

std::optional<Channel> find_channel(std::string_view name, std::string_view prefix) {
  for (const Channel channel : kAllChannels) {
    if (name == channel_name(channel, prefix)) return channel;
  }
  return std::nullopt;
}

std::optional<Channel> find_channel_of_any_prefix(std::string_view name) {
  for (const Channel channel : kAllChannels) {
    const std::string_view base = base_name(channel);
    if (name == base) return channel;
    if (!name.ends_with(base)) continue;
    const std::string_view prefix = name.substr(0, name.size() - base.size());
    if (prefix.size() < 2 || !prefix.ends_with('_')) continue;
    try {
      check_prefix(prefix.substr(0, prefix.size() - 1));
      return channel;
    } catch (const BusError&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

void check_prefix(std::string_view prefix, std::string_view key) {
  constexpr std::size_t kMaxLength = 16;
  const bool known = std::all_of(prefix.begin(), prefix.end(), [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (prefix.size() > kMaxLength || !known) {
    throw BusError(std::string(key) + " must be up to 16 of A-Z, 0-9 and _, got \"" +
                   std::string(prefix) + "\"");
  }
}

}  // namespace puck
