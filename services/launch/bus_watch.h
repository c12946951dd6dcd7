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

  /// Adds messages_rejected, messages_lost, messages_late (or twice), handler_failures and
  /// publish_failures, of all channels.
  void report(StatusReport& report) const;

 private:
  void look_at(Channel channel);

  const Bus& bus_;
  spdlog::logger& log_;
  std::chrono::steady_clock::time_point due_;
  std::array<ChannelCounters, kAllChannels.size()> seen_;
};

}  // namespace puck
