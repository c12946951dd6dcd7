#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/messaging/log_bytes.h"
#include "common/messaging/log_format.h"
#include "common/posix/file_descriptor.h"

namespace puck {

/// A log that cannot be opened or written, in one line with its path.
class LogFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An open log, for whoever writes it and whoever puts it on the disk. Closes with the last of
/// them; until then no other LogWriter, of any process, writes it.
class OpenLog {
 public:
  /// Throws LogFileError; so it does when the file exists, unless `overwrite`, or while another
  /// writes it.
  OpenLog(const std::filesystem::path& path, bool overwrite);

  int descriptor() const { return file_.number(); }
  const std::filesystem::path& path() const { return path_; }

  /// Returns when all that was written before is on the disk, the file's name included: a crash of
  /// the machine cannot take it any more. Throws LogFileError. One thread.
  void put_on_disk();
  /// Nothing more is written: from now on it is an old log, which may be removed.
  void unlock();

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
  bool name_is_on_disk_ = false;
};

/// Writes the log format of LCM, which lcm-logplayer plays. Whatever goes wrong, the file holds
/// whole messages, unless the process is killed within a write or the disk fails. One thread.
class LogWriter {
 public:
  /// Throws LogFileError; so it does when the file exists, unless `overwrite`.
  explicit LogWriter(const std::filesystem::path& path, bool overwrite = false);
  /// Flushes and unlocks.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// `utime`: when it was received, CLOCK_REALTIME, µs. Throws LogFileError when the disk is full:
  /// all since the last flush is lost then.
  void write(std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> bytes);
  /// Hands what was written to the system, so that it outlives the process. Throws LogFileError.
  void flush();

  /// Flushes, then writes whole records that lie one after the other, as put_log_record() makes
  /// them; only their numbers are set first. Throws LogFileError when the disk is full; then none
  /// of them is in the file.
  void write_records(std::span<std::uint8_t> records);

  std::int64_t messages() const { return messages_; }
  std::int64_t bytes() const { return bytes_; }  ///< Size of the file when flushed.
  /// The file, to have it put on the disk by another thread.
  const std::shared_ptr<OpenLog>& file() const { return file_; }

  /// What one message takes in the file.
  static std::int64_t record_bytes(std::string_view channel, std::size_t message_bytes);

 private:
  void write_whole(std::span<const std::uint8_t> bytes);

  std::shared_ptr<OpenLog> file_;
  std::vector<std::uint8_t> buffer_;
  std::int64_t buffered_messages_ = 0;
  std::int64_t messages_ = 0;
  std::int64_t bytes_ = 0;
  std::int64_t bytes_in_file_ = 0;
};

/// One message of a log.
struct LogRecord {
  std::int64_t number = 0;  ///< As the writer counted.
  std::int64_t utime = 0;   ///< When the logger received it, CLOCK_REALTIME, µs.
  std::string channel;
  std::vector<std::uint8_t> bytes;  ///< Unchecked: decode() it.
  std::int64_t offset = 0;          ///< Where in the file its record begins.
};

/// A place of a log that is not part of any whole message.
struct LogDamage {
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
  std::string why;  ///< "the log ends within a message", …
};

/// Reads logs of LCM, whole or damaged, of any size in constant memory. Where something is wrong it
/// searches for the next message, so that damage costs the messages that it hits and no other: also
/// where a length was hit and points into, or beyond, the messages after. One thread.
class LogReader {
 public:
  /// Throws LogFileError when there is no such file or no message begins in its first MiB.
  explicit LogReader(const std::filesystem::path& path);

  /// Called with every damaged place before the message after it is returned.
  void on_damage(std::function<void(const LogDamage&)> call) { on_damage_ = std::move(call); }

  /// False at the end.
  bool next(LogRecord& record);

  std::int64_t size() const { return bytes_.size(); }            ///< Of the file, bytes.
  std::int64_t bytes_skipped() const { return bytes_skipped_; }  ///< Not part of any whole message.
  /// What was wrong with the first damaged place, with its offset; nothing in a whole log.
  const std::optional<std::string>& damage() const { return damage_; }

 private:
  /// From here up to there no message begins.
  struct Searched {
    std::int64_t from = 0;
    std::int64_t to = 0;
  };

  std::optional<std::string> find_problem(const LogHeader& header);
  std::int64_t next_message_from(std::int64_t offset, Searched& searched);
  bool message_may_begin(std::int64_t offset);
  bool message_begins(std::int64_t offset);
  void skip_damage(std::string why);

  LogBytes bytes_;
  std::int64_t offset_ = 0;
  std::int64_t bytes_skipped_ = 0;
  std::optional<std::string> damage_;
  std::function<void(const LogDamage&)> on_damage_;
  // Where no message begins is not searched again and again: neither behind damage, nor behind the
  // end that a length claims.
  Searched behind_damage_;
  Searched behind_end_;
};

}  // namespace puck
