#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "common/io/config.h"
#include "common/messaging/loss_accounting.h"
#include "services/launch/service.h"
#include "services/logger/channel_tally.h"
#include "services/logger/log_files.h"
#include "services/logger/log_sync.h"
#include "services/logger/log_thread.h"
#include "services/logger/logger_params.h"

namespace puck {

/// Writes all messages on any channel under its prefix, valid or not, to a log for lcm-logplayer.
/// Counts unwritten messages by channel and then reports STATUS degraded.
///
/// Three threads: this one receives, LogThread writes, LogSync waits for the disk.
class LoggerService : public Service {
 public:
  static LoggerParams read_params(Config& config) { return read_logger_params(config); }

  /// Throws LogFileError if the log cannot be created.
  LoggerService(const LoggerParams& params, ServiceContext& context);

  void run(std::stop_token stop) override;
  void report(StatusReport& report) const override;

  /// Path of the file being written.
  std::string path() const { return files_.progress().path; }

 private:
  using Clock = std::chrono::steady_clock;

  void receive(std::string_view channel, std::span<const std::uint8_t> bytes,
               const Receipt& receipt);
  void account_for_events(std::span<const std::uint8_t> bytes);
  std::optional<std::string> find_trouble() const;
  void tell_of_progress();

  ServiceContext& context_;
  const std::string events_channel_;
  LogSync sync_;
  LogFiles files_;
  ChannelTally not_queued_;
  std::size_t taken_bytes_ = 0;  // since the last call of handle()
  Clock::time_point queue_was_full_until_{};
  std::optional<std::string> trouble_;  // As logged last.
  std::string told_path_;
  std::int64_t packets_rejected_ = 0;
  LossAccount events_;
  LogThread thread_;  // Last, so that it ends before what it writes into.
};

}  // namespace puck
