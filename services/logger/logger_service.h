#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <stop_token>
#include <string>

#include "common/io/config.h"
#include "common/messaging/log_file.h"
#include "common/messaging/loss_accounting.h"
#include "services/launch/service.h"

namespace puck {

struct LoggerParams {
  /// Key logger.path. May hold conversions of strftime(3) for the local time of the start.
  std::string path = "puck-%Y-%m-%d-%H-%M-%S.lcm";
  bool overwrite = false;      ///< Key logger.overwrite: write over an existing file.
  std::int64_t max_bytes = 0;  ///< Key logger.max_bytes: then it stops writing; 0: no limit.
};

/// Writes all that comes on any channel under its prefix, valid or not, to a log that lcm-logplayer
/// plays. What it cannot write it counts and says: STATUS turns degraded.
class LoggerService : public Service {
 public:
  static LoggerParams read_params(Config& config);

  /// Throws LogFileError when the log cannot be made.
  LoggerService(const LoggerParams& params, ServiceContext& context);

  void run(std::stop_token stop) override;
  void report(StatusReport& report) const override;

  const std::string& path() const { return path_; }

 private:
  void receive(const std::string& channel, std::span<const std::uint8_t> bytes,
               const Receipt& receipt);
  void write(const std::string& channel, std::span<const std::uint8_t> bytes,
             const Receipt& receipt);
  void account_for_events(std::span<const std::uint8_t> bytes);
  void flush_when_due();
  void stop_writing(const std::string& why);

  ServiceContext& context_;
  const std::string path_;
  const std::int64_t max_bytes_;
  const std::string events_channel_;
  LogWriter writer_;
  bool writing_ = true;
  std::chrono::steady_clock::time_point flush_due_;
  std::int64_t not_written_ = 0;
  std::int64_t packets_rejected_ = 0;
  LossAccount events_;
};

}  // namespace puck
