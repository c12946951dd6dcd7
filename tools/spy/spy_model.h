#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "common/messaging/receipt.h"
#include "tools/spy/channel_account.h"
#include "tools/spy/service_list.h"
#include "tools/spy/snapshot.h"
#include "tools/spy/spy_params.h"

namespace puck {

/// All that puck-spy knows of the bus. Fed with what a Bus hands to subscribe_all(); knows neither
/// bus, clock nor screen. One thread.
class SpyModel {
 public:
  /// Times are CLOCK_MONOTONIC, µs.
  SpyModel(std::string prefix, const SpyParams& params, std::int64_t start_us);

  void hear(std::string_view channel, std::span<const std::uint8_t> bytes, const Receipt& receipt);

  /// What was dropped of a channel of ours before it could be heard, in all, for want of our key;
  /// and why.
  void set_unauthenticated(Channel channel, std::int64_t messages, const std::string& why,
                           std::int64_t now_us);

  /// Rates are over the time between the snapshots of the rate window.
  Snapshot snapshot(std::int64_t now_us);

 private:
  ChannelAccount& account_of(std::string_view channel, std::int64_t now_us);

  std::string prefix_;
  SpyParams params_;
  std::int64_t start_us_;
  std::map<std::string, ChannelAccount, std::less<>> accounts_;
  ServiceList services_;
  std::int64_t messages_ = 0;
};

}  // namespace puck
