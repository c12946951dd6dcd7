#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/loss_accounting.h"
#include "common/messaging/receipt.h"
#include "tools/spy/publisher_list.h"
#include "tools/spy/rate_window.h"
#include "tools/spy/snapshot.h"
#include "tools/spy/spy_params.h"

namespace puck {

/// What came on one channel. Of a message no more is read than its check, its header and, of
/// EVENTS, the numbering of the events.
class ChannelAccount {
 public:
  /// `type`: nothing for a name that is not ours. `from_us`: nothing had come by then.
  ChannelAccount(std::string name, std::optional<Channel> type, const SpyParams& params,
                 std::int64_t from_us);

  std::optional<Channel> type() const { return type_; }

  /// Whether it is a valid message of a type of ours.
  bool hear(std::span<const std::uint8_t> bytes, const Receipt& receipt);

  /// What was dropped before it could be heard, in all, for want of our key; and why.
  void set_unauthenticated(std::int64_t messages, std::string why);

  /// The names of the publishers are left empty.
  ChannelRow row(std::int64_t now_us);

 private:
  std::optional<std::string> reject(std::span<const std::uint8_t> bytes);
  void hear_valid(std::span<const std::uint8_t> bytes, const Receipt& receipt);
  void fill_publishers(ChannelRow& row, std::int64_t now_us) const;

  std::string name_;
  std::optional<Channel> type_;
  SpyParams params_;
  RateWindow rates_;
  Traffic sums_;
  LossAccount account_;
  std::int64_t malformed_ = 0;
  std::int64_t oversize_ = 0;
  std::int64_t unauthenticated_ = 0;
  std::string last_rejection_;
  std::optional<std::int64_t> newest_us_;
  PublisherList publishers_;
  std::vector<std::uint8_t> newest_;  // Its memory is used again.
};

}  // namespace puck
