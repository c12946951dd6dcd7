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

/// The model behind puck-spy, fed by Bus::subscribe_all(). Independent of bus, clock and screen.
/// One thread.
class SpyModel {
 public:
  /// Times are CLOCK_MONOTONIC, µs.
  SpyModel(std::string prefix, const SpyParams& params, std::int64_t start_us);

  void hear(std::string_view channel, std::span<const std::uint8_t> bytes, const Receipt& receipt);

  /// Total of a PUCK channel's messages dropped for lack of our key, and the reason.
  void set_unauthenticated(Channel channel, std::int64_t messages, const std::string& why,
                           std::int64_t now_us);

  /// Rates cover the snapshots within the rate window.
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
