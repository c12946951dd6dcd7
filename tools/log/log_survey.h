#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "common/messaging/loss_accounting.h"
#include "tools/log/log_messages.h"

namespace puck {

/// Figures of one channel of a log.
struct ChannelSurvey {
  std::optional<Channel> channel;
  std::int64_t messages = 0;
  std::int64_t bytes = 0;  ///< Without record headers.
  std::int64_t malformed = 0;
  std::int64_t first_utime = 0;
  std::int64_t last_utime = 0;
  std::int64_t longest_gap_us = 0;    ///< Between consecutive messages.
  std::int64_t longest_gap_from = 0;  ///< Its begin.
  std::int64_t events = 0;
  LossAccount account;

  /// Empty without a time span.
  std::optional<double> rate_hz() const;
  std::optional<double> mb_s() const;
  std::optional<double> mev_s() const;
};

struct LogSurvey {
  std::int64_t file_bytes = 0;
  std::int64_t first_utime = 0;
  std::int64_t last_utime = 0;
  LogTally tally;
  std::optional<std::string> first_damage;
  std::map<std::string, ChannelSurvey> channels;  ///< Channels beyond the first 1000 share kOther.

  static constexpr const char* kOther = "(others)";
  double duration_s() const { return static_cast<double>(last_utime - first_utime) * 1e-6; }
};

/// Throws LogFileError.
LogSurvey survey_log(const std::filesystem::path& path);

}  // namespace puck
