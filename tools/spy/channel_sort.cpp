#include "tools/spy/channel_sort.h"

#include <algorithm>
#include <limits>

namespace puck {
namespace {

/// A double is exact enough for rates, counts and µs on a screen.
double value_of(const ChannelRow& channel, ChannelSort sort) {
  switch (sort) {
    case ChannelSort::kFlow:
      return 0;
    case ChannelSort::kMessages:
      return channel.messages_per_s;
    case ChannelSort::kBytes:
      return channel.bytes_per_s;
    case ChannelSort::kReceived:
      return static_cast<double>(channel.arrivals.received);
    case ChannelSort::kLost:
      return static_cast<double>(channel.arrivals.lost);
    case ChannelSort::kMalformed:
      return static_cast<double>(channel.malformed);
    case ChannelSort::kAge:
      return channel.newest_age_us ? static_cast<double>(*channel.newest_age_us)
                                   : std::numeric_limits<double>::infinity();
  }
  return 0;
}

}  // namespace

ChannelSort next_sort(ChannelSort sort) {
  if (sort == ChannelSort::kAge) return ChannelSort::kFlow;
  return static_cast<ChannelSort>(static_cast<int>(sort) + 1);
}

const char* to_string(ChannelSort sort) {
  switch (sort) {
    case ChannelSort::kFlow:
      return "channel";
    case ChannelSort::kMessages:
      return "msg/s";
    case ChannelSort::kBytes:
      return "B/s";
    case ChannelSort::kReceived:
      return "received";
    case ChannelSort::kLost:
      return "lost";
    case ChannelSort::kMalformed:
      return "bad";
    case ChannelSort::kAge:
      return "age";
  }
  return "";
}

std::vector<ChannelRow> sorted(std::vector<ChannelRow> channels, ChannelSort sort, bool reverse) {
  std::stable_sort(channels.begin(), channels.end(),
                   [sort](const ChannelRow& a, const ChannelRow& b) {
                     return value_of(a, sort) > value_of(b, sort);
                   });
  if (reverse) std::reverse(channels.begin(), channels.end());
  return channels;
}

}  // namespace puck
