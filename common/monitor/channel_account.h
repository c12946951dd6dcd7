#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/loss_accounting.h"
#include "common/messaging/receipt.h"
#include "common/monitor/bus_snapshot.h"
#include "common/monitor/monitor_params.h"
#include "common/monitor/publisher_list.h"
#include "common/monitor/rate_window.h"

namespace puck {

/// Counts the messages of one channel. Decodes only a message's check, its header and, of EVENTS,
/// the numbering of the events.
class ChannelAccount {
 public:
  /// `type`: empty for a foreign name. `from_us`: start of listening.
  ChannelAccount(std::string name, std::optional<Channel> type, const MonitorParams& params,
                 std::int64_t from_us);

  std::optional<Channel> type() const { return type_; }

  /// Whether it is a valid message of a PUCK type.
  bool hear(std::span<const std::uint8_t> bytes, const Receipt& receipt);

  /// Total of messages dropped for lack of our key, and the reason.
  void set_unauthenticated(std::int64_t messages, std::string why);

  /// Leaves the publishers' names empty.
  ChannelRow row(std::int64_t now_us);

 private:
  std::optional<std::string> reject(std::span<const std::uint8_t> bytes);
  void hear_valid(std::span<const std::uint8_t> bytes, const Receipt& receipt);
  void fill_publishers(ChannelRow& row, std::int64_t now_us) const;

  std::string name_;
  std::optional<Channel> type_;
  MonitorParams params_;
  RateWindow rates_;
  Traffic sums_;
  LossAccount account_;
  std::int64_t malformed_ = 0;
  std::int64_t oversize_ = 0;
  std::int64_t unauthenticated_ = 0;
  std::string last_rejection_;
  std::optional<std::int64_t> newest_us_;
  PublisherList publishers_;
  std::vector<std::uint8_t> newest_;  // Keeps its memory.
};

}  // namespace puck
