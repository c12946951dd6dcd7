#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/messaging/channels.h"
#include "common/messaging/status_reporter.h"

namespace puck {

/// Counts messages by channel. All foreign channels count as one, since their number is unlimited.
/// One thread.
class ChannelTally {
 public:
  explicit ChannelTally(std::string_view prefix) {
    for (const Channel channel : kAllChannels) name_of(channel) = channel_name(channel, prefix);
  }

  void add(std::string_view channel) {
    ++total_;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i] == channel) {
        ++counts_[i];
        return;
      }
    }
    ++counts_.back();
  }
  void add(const ChannelTally& other) {
    total_ += other.total_;
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  }

  std::int64_t total() const { return total_; }
  /// Adds `what`, then `what.PUCK_EVENTS` for each channel that was counted.
  void report(const std::string& what, StatusReport& report) const {
    report.counters.emplace_back(what, total_);
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (counts_[i] == 0) continue;
      report.counters.emplace_back(what + "." + (i < names_.size() ? names_[i] : "other"),
                                   counts_[i]);
    }
  }

 private:
  std::string& name_of(Channel channel) { return names_[static_cast<std::size_t>(channel)]; }

  std::array<std::string, kAllChannels.size()> names_;
  std::array<std::int64_t, kAllChannels.size() + 1> counts_{};
  std::int64_t total_ = 0;
};

}  // namespace puck
