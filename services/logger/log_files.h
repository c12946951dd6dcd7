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

/// What became of the messages so far.
struct LogProgress {
  std::string path;           ///< Of the file being written, or of the last one.
  std::int64_t messages = 0;  ///< Written, in all files.
  std::int64_t bytes = 0;     ///< Of all files of this run.
  std::int64_t files = 0;     ///< Begun.
  std::int64_t files_removed = 0;
  std::optional<std::string> problem;  ///< Why nothing is written now.
  std::string quota_problem;           ///< Why the quota is not kept, else empty.
};

/// The files of a log: one, or, when it rotates, one after the other, of which the oldest go when
/// the quota wants it. While there is a problem, messages are counted instead of written; once a
/// second it tries whether they can be written again. Writer thread only, but for progress() and
/// not_written().
class LogFiles {
 public:
  /// Begins the first file. Throws LogFileError, and std::invalid_argument for a useless path.
  LogFiles(const LoggerParams& params, std::string_view prefix, LogSync& sync);

  /// Takes the first of these records, as many as are written at a time, and returns their bytes.
  /// Every other problem than records that are none ends up in progress().
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
  std::unique_ptr<LogWriter> writer_;  // nullptr: the next file could not be begun.
  std::filesystem::path folder_;
  std::int64_t file_began_utime_ = 0;
  std::int64_t messages_before_ = 0;  // In the files before this one, as are the bytes.
  std::int64_t bytes_before_ = 0;
  bool is_full_ = false;  // For good: logger.max_bytes.
  Clock::time_point next_try_;

  mutable std::mutex mutex_;
  LogProgress progress_;      // Guarded by mutex_.
  ChannelTally not_written_;  // Guarded by mutex_.
};

}  // namespace puck
