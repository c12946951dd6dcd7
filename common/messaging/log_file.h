#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

struct _lcm_eventlog_t;

namespace puck {

/// A log that cannot be opened or written, in one line with its path.
class LogFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes the log format of LCM, which lcm-logplayer plays. One thread.
class LogWriter {
 public:
  /// Throws LogFileError; so it does when the file exists, unless `overwrite`.
  explicit LogWriter(const std::filesystem::path& path, bool overwrite = false);
  /// Flushes.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// `utime`: when it was received, CLOCK_REALTIME, µs. Throws LogFileError when the disk is full.
  void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes);
  /// Throws LogFileError when what was written does not reach the file.
  void flush();

  std::int64_t messages() const { return messages_; }
  std::int64_t bytes() const { return bytes_; }  ///< Size of the file when flushed.

  /// What one message takes in the file.
  static std::int64_t record_bytes(const std::string& channel, std::size_t message_bytes);

 private:
  struct Closer {
    void operator()(_lcm_eventlog_t* log) const;
  };

  std::filesystem::path path_;
  std::unique_ptr<_lcm_eventlog_t, Closer> log_;
  std::int64_t messages_ = 0;
  std::int64_t bytes_ = 0;
};

/// One message of a log.
struct LogRecord {
  std::int64_t number = 0;  ///< As the writer counted.
  std::int64_t utime = 0;   ///< When the logger received it, CLOCK_REALTIME, µs.
  std::string channel;
  std::vector<std::uint8_t> bytes;  ///< Unchecked: decode() it.
};

/// Reads logs of LCM, whole or damaged. Where something is wrong it searches for the next message
/// and counts what it skipped. One thread.
class LogReader {
 public:
  /// Throws LogFileError when there is no such file or it does not begin with a message.
  explicit LogReader(const std::filesystem::path& path);
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  /// False at the end.
  bool next(LogRecord& record);

  std::int64_t bytes_skipped() const { return bytes_skipped_; }  ///< Not part of any whole message.
  /// What was wrong with the first damaged place, with its offset; nothing in a whole log.
  const std::optional<std::string>& damage() const { return damage_; }

 private:
  enum class Outcome { kRecord, kDamage, kEnd };

  Outcome read_record(LogRecord& record, std::string& why);
  void skip_to_next_record();

  struct Closer {
    void operator()(std::FILE* file) const;
  };

  std::unique_ptr<std::FILE, Closer> file_;
  std::int64_t size_ = 0;
  std::int64_t offset_ = 0;
  std::int64_t bytes_skipped_ = 0;
  std::optional<std::string> damage_;
};

}  // namespace puck
