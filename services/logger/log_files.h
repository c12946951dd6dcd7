#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "common/messaging/log_file.h"
#include "services/logger/channel_tally.h"
#include "services/logger/log_names.h"
#include "services/logger/log_sync.h"
#include "services/logger/logger_params.h"

namespace puck {

/// State of the log's files.
struct LogProgress {
  std::string path;           ///< The file being written, or the last one.
  std::int64_t messages = 0;  ///< Written, in all files.
  std::int64_t bytes = 0;     ///< Size of all files of this run.
  std::int64_t files = 0;     ///< Files opened.
  std::int64_t files_removed = 0;
  std::optional<std::string> problem;  ///< Reason why writing is paused.
  std::string quota_problem;           ///< Reason why the quota is not kept; else empty.
};

/// The files of a log: a single one, or rotated ones, of which the quota removes the oldest. During
/// a problem, messages are counted instead of written, with a new attempt every second. Writer
/// thread only, except progress() and not_written().
class LogFiles {
 public:
  /// Opens the first file. Throws LogFileError, and std::invalid_argument for an invalid path.
  LogFiles(const LoggerParams& params, std::string_view prefix, LogSync& sync);

  /// Writes the first of these records, up to the size of one write, and returns their bytes.
  /// Throws for malformed records; reports other problems in progress().
  std::size_t write(std::span<std::uint8_t> records);

  /// Safe from any thread.
  LogProgress progress() const;
  /// Safe from any thread.
  ChannelTally not_written() const;

 private:
  using Clock = std::chrono::steady_clock;

  void begin_first_file(std::time_t start);
  void begin_rotated_file();
  bool belongs_into_next_file(const LogHeader& header, std::size_t run_bytes) const;
  bool exceeds_max(std::size_t run_bytes) const;
  std::size_t run_of(std::span<const std::uint8_t> records) const;
  std::optional<std::string> obstacle(std::size_t bytes);
  void discard(std::span<const std::uint8_t> records);
  void stop_for(std::string problem);
  void note_written();

  const LoggerParams params_;
  LogSync& sync_;
  std::optional<LogNames> names_;
  int next_number_ = 0;
  std::unique_ptr<LogWriter> writer_;  // nullptr: the next file could not be opened.
  std::filesystem::path folder_;
  std::int64_t file_began_utime_ = 0;
  std::int64_t messages_before_ = 0;  // In earlier files, as are the bytes.
  std::int64_t bytes_before_ = 0;
  bool is_full_ = false;  // Permanent: logger.max_bytes.
  Clock::time_point next_try_;

  mutable std::mutex mutex_;
  LogProgress progress_;      // Guarded by mutex_.
  ChannelTally not_written_;  // Guarded by mutex_.
};

}  // namespace puck
