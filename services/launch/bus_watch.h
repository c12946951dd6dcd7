#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include <spdlog/logger.h>

#include "common/messaging/bus.h"
#include "common/messaging/status_reporter.h"

namespace puck {

/// Logs new problems of the bus, and sums up its counters for STATUS, for all services. One thread.
class BusWatch {
 public:
  BusWatch(const Bus& bus, spdlog::logger& log) : bus_(bus), log_(log) {}

  /// Looks at most once a second.
  void poll();
  /// Looks at once.
  void look();

  /// Adds totals of all channels: messages_received, messages_lost, … messages_rejected includes
  /// oversize ones. Rare ones are left out while zero: messages_duplicate, messages_oversize,
  /// messages_unauthenticated, messages_foreign (of no PUCK channel) and network_rejoined.
  void report_totals(StatusReport& report) const;
  /// Adds the counters of each channel that are not zero: PUCK_EVENTS.received, and .publishers if
  /// there was more than one.
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
