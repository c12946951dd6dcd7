#include "common/monitor/bus_monitor.h"

#include <algorithm>

#include "common/messaging/message_codec.h"

namespace puck {
namespace {

// Bounds the memory for foreign names; further ones are counted together.
constexpr std::size_t kMaxChannels = kAllChannels.size() + 32;
constexpr std::string_view kMoreNames = "(more names)";

}  // namespace

BusMonitor::BusMonitor(std::string prefix, const MonitorParams& params, std::int64_t start_us)
    : prefix_(std::move(prefix)), params_(params), start_us_(start_us), services_(params) {}

std::optional<Channel> BusMonitor::hear(std::string_view channel,
                                        std::span<const std::uint8_t> bytes,
                                        const Receipt& receipt) {
  ++messages_;
  ChannelAccount& account = account_of(channel, receipt.monotonic_us);
  if (!account.hear(bytes, receipt)) return std::nullopt;
  if (account.type() == Channel::kStatus) {
    service_status_t status;
    decode_checked(bytes, status);
    services_.hear(status, receipt.monotonic_us);
  }
  return account.type();
}

void BusMonitor::set_unauthenticated(Channel channel, std::int64_t messages, const std::string& why,
                                     std::int64_t now_us) {
  if (messages > 0) {
    account_of(channel_name(channel, prefix_), now_us).set_unauthenticated(messages, why);
  }
}

ChannelAccount& BusMonitor::account_of(std::string_view channel, std::int64_t now_us) {
  const auto known = accounts_.find(channel);
  if (known != accounts_.end()) return known->second;
  const auto type = find_channel(channel, prefix_);
  const std::string name(type || accounts_.size() < kMaxChannels ? channel : kMoreNames);
  const std::int64_t window_us = std::min(params_.rate_window_us, now_us - start_us_);
  return accounts_.try_emplace(name, name, type, params_, now_us - window_us).first->second;
}

BusSnapshot BusMonitor::snapshot(std::int64_t now_us) {
  BusSnapshot snapshot{.listened_us = now_us - start_us_, .messages = messages_};
  for (auto& [name, account] : accounts_) {
    ChannelRow& row = snapshot.channels.emplace_back(account.row(now_us));
    for (PublisherRow& publisher : row.publishers) services_.name(publisher);
  }
  std::stable_sort(snapshot.channels.begin(), snapshot.channels.end(),
                   [](const ChannelRow& a, const ChannelRow& b) {
                     if (a.type && b.type) return *a.type < *b.type;
                     return a.type.has_value() && !b.type.has_value();
                   });
  snapshot.services = services_.rows(now_us);
  return snapshot;
}

}  // namespace puck
