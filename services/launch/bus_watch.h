#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include <spdlog/logger.h>

#include "common/messaging/bus.h"
#include "common/messaging/status_reporter.h"

namespace puck {

/// Says on the log what went wrong on the bus since it last looked, and sums it up for STATUS, so
/// that no service has to. One thread.
class BusWatch {
 public:
  BusWatch(const Bus& bus, spdlog::logger& log) : bus_(bus), log_(log) {}

  /// Looks when a second has passed.
  void poll();
  /// Looks now.
  void look();

  /// Adds what came and how, of all channels together: messages_received, messages_lost, …
  /// messages_rejected holds those that are oversize, too. Those that are rare are left out while
  /// they are zero: messages_duplicate, messages_oversize, messages_unauthenticated,
  /// messages_foreign (not ours at all) and network_rejoined.
  void report_totals(StatusReport& report) const;
  /// Adds of each single channel what is not zero: PUCK_EVENTS.received, and .publishers where it
  /// had more than one.
  void report_channels(StatusReport& report) const;

 private:
  void look_at(const ChannelCounters& now, ChannelCounters& before);
  void look_at_network();
  static void report_channel(Channel channel, const ChannelCounters& counters,
                             StatusReport& report);

  const Bus& bus_;
  spdlog::logger& log_;
  std::chrono::steady_clock::time_point due_;
  std::array<ChannelCounters, kAllChannels.size()> seen_;
  ChannelCounters unknown_seen_;
  TransportCounters network_seen_;
};

}  // namespace puck
