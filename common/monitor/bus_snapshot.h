#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/loss_accounting.h"
#include "common/messaging/status_reporter.h"
#include "common/messaging/transport.h"

namespace puck {

/// One run of a publisher on a channel.
struct PublisherRow {
  std::int64_t session = 0;
  std::string service;  ///< From the STATUS of the same session; empty: not heard.
  std::string host;
  std::int32_t pid = 0;
  Sender sender{};  ///< Source of its newest message.
  std::int64_t messages = 0;
  std::int64_t age_us = 0;  ///< Of its newest message.
};

/// Figures of one channel.
struct ChannelRow {
  std::string name;             ///< With the prefix.
  std::optional<Channel> type;  ///< Empty: a foreign name.

  double messages_per_s = 0;  ///< All messages, valid or not.
  double bytes_per_s = 0;     ///< The same.
  double events_per_s = 0;    ///< EVENTS only.

  LossCounters arrivals;            ///< Of valid messages; on a foreign channel: of all.
  std::int64_t received_bytes = 0;  ///< Valid or not.
  std::int64_t malformed = 0;
  std::int64_t oversize = 0;         ///< Larger than the type's maximum.
  std::int64_t unauthenticated = 0;  ///< Not sealed with our key.
  std::string last_rejection;        ///< Reason and sender of the newest rejection.
  bool in_trouble = false;  ///< Loss, lateness or malformed messages within the rate window.
  /// Of the newest message, valid or not; empty if all were dropped for lack of our key.
  std::optional<std::int64_t> newest_age_us;

  std::vector<PublisherRow> publishers;  ///< Those heard recently, the oldest run first.
  bool several_publishers = false;       ///< At the same time, where one is expected.

  std::vector<std::uint8_t> newest;  ///< Bytes of the newest valid message.
};

/// The last STATUS of a service.
struct ServiceRow {
  std::int64_t session = 0;
  std::string service;
  std::string host;
  std::int32_t pid = 0;
  std::string version;
  ServiceState state = ServiceState::kStarting;
  std::string state_text;
  std::int64_t uptime_us = 0;      ///< At that STATUS.
  std::int64_t status_age_us = 0;  ///< Since that STATUS.
  bool silent = false;             ///< Overdue, without a stop announced.
  std::vector<std::pair<std::string, std::int64_t>> counters;
  std::vector<StatusLatency> latencies;
};

/// `running`, …; `silent` if STATUS is overdue, `stopped` after its last STATUS.
std::string state_of(const ServiceRow& service);

/// Data for drawing and reporting, at one moment.
struct BusSnapshot {
  std::int64_t listened_us = 0;
  std::vector<ChannelRow> channels;  ///< In the order of enum Channel, then foreign names.
  std::vector<ServiceRow> services;  ///< By name, host and pid.
  std::int64_t messages = 0;         ///< On any channel, valid or not.
  TransportCounters network;         ///< Foreign and malformed datagrams on this group and port.
  /// On unknown PUCK channels, without our key.
  std::int64_t unknown_unauthenticated = 0;
};

}  // namespace puck
