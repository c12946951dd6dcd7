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

/// One run of a program that publishes on a channel.
struct PublisherRow {
  std::int64_t session = 0;
  std::string service;  ///< From the STATUS of the same session; empty: no such STATUS was heard.
  std::string host;
  std::int32_t pid = 0;
  Sender sender{};  ///< Of its newest message, as the network says.
  std::int64_t messages = 0;
  std::int64_t age_us = 0;  ///< Of its newest message.
};

/// What came on one channel.
struct ChannelRow {
  std::string name;             ///< With the prefix.
  std::optional<Channel> type;  ///< Nothing: a name that is not one of ours.

  double messages_per_s = 0;  ///< All that came, valid or not.
  double bytes_per_s = 0;     ///< The same.
  double events_per_s = 0;    ///< EVENTS only.

  LossCounters arrivals;            ///< Of the valid messages; of a foreign name: of all.
  std::int64_t received_bytes = 0;  ///< Valid or not.
  std::int64_t malformed = 0;
  std::int64_t oversize = 0;         ///< Larger than its type can be.
  std::int64_t unauthenticated = 0;  ///< Not sealed with our key.
  std::string last_rejection;        ///< Why the newest of these was rejected, and who sent it.
  bool in_trouble = false;  ///< Loss, lateness or malformed messages within the rate window.
  /// Of the newest message, valid or not; nothing when all were dropped for want of our key.
  std::optional<std::int64_t> newest_age_us;

  std::vector<PublisherRow> publishers;  ///< Those heard lately, the oldest run first.
  bool several_publishers = false;       ///< They publish at the same time where one should.

  std::vector<std::uint8_t> newest;  ///< Bytes of the newest valid message.
};

/// What a service last said of itself.
struct ServiceRow {
  std::int64_t session = 0;
  std::string service;
  std::string host;
  std::int32_t pid = 0;
  std::string version;
  ServiceState state = ServiceState::kStarting;
  std::string state_text;
  std::int64_t uptime_us = 0;      ///< When it said so.
  std::int64_t status_age_us = 0;  ///< Since then.
  bool silent = false;             ///< Too long since then, and it did not say that it stops.
  std::vector<std::pair<std::string, std::int64_t>> counters;
  std::vector<StatusLatency> latencies;
};

/// All that is known at one moment: what is drawn and reported.
struct Snapshot {
  std::int64_t listened_us = 0;
  std::vector<ChannelRow> channels;  ///< In the order of enum Channel, then foreign names.
  std::vector<ServiceRow> services;  ///< By name, host and pid.
  std::int64_t messages = 0;         ///< On any channel, valid or not.
  TransportCounters network;         ///< What came from others at this group and port.
  /// On channels that are none of ours, without our key.
  std::int64_t unknown_unauthenticated = 0;
};

}  // namespace puck
