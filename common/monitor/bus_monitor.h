#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/messaging/receipt.h"
#include "common/monitor/bus_snapshot.h"
#include "common/monitor/channel_account.h"
#include "common/monitor/monitor_params.h"
#include "common/monitor/service_list.h"

namespace puck {

/// What is on the bus: channels, their publishers, rates and losses, and services. Fed by
/// Bus::subscribe_all(); independent of bus, clock and screen.
/// One thread.
class BusMonitor {
 public:
  /// Times are CLOCK_MONOTONIC, µs.
  BusMonitor(std::string prefix, const MonitorParams& params, std::int64_t start_us);

  /// The channel of a message that passed all checks, so that it can be decoded; else nothing.
  std::optional<Channel> hear(std::string_view channel, std::span<const std::uint8_t> bytes,
                              const Receipt& receipt);

  /// Total of a PUCK channel's messages dropped for lack of our key, and the reason.
  void set_unauthenticated(Channel channel, std::int64_t messages, const std::string& why,
                           std::int64_t now_us);

  /// Rates cover the snapshots within the rate window.
  BusSnapshot snapshot(std::int64_t now_us);

 private:
  ChannelAccount& account_of(std::string_view channel, std::int64_t now_us);

  std::string prefix_;
  MonitorParams params_;
  std::int64_t start_us_;
  std::map<std::string, ChannelAccount, std::less<>> accounts_;
  ServiceList services_;
  std::int64_t messages_ = 0;
};

}  // namespace puck
