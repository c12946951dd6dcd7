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

/// A log cannot be opened, read or written; one line with its path.
class LogFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An open log, shared by its writer and the thread that syncs it. The last owner closes it; until
/// then no other LogWriter of any process can write it.
class OpenLog {
 public:
  /// Throws LogFileError, also if the file exists and not `overwrite`, or while another process
  /// writes it.
  OpenLog(const std::filesystem::path& path, bool overwrite);

  int descriptor() const { return file_.number(); }
  const std::filesystem::path& path() const { return path_; }

  /// Returns when all data written before, and the file's name, are on the disk and survive a crash
  /// of the machine. Throws LogFileError. One thread.
  void put_on_disk();
  /// Marks the log as finished, so that it may be removed.
  void unlock();

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
  bool name_is_on_disk_ = false;
};

/// Writes LCM's log format, which lcm-logplayer plays. The file holds whole messages after any
/// error, except if the process is killed within a write or the disk fails. One thread.
class LogWriter {
 public:
  /// Throws LogFileError, also if the file exists and not `overwrite`.
  explicit LogWriter(const std::filesystem::path& path, bool overwrite = false);
  /// Flushes and unlocks.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// `utime`: time of receipt, CLOCK_REALTIME, µs. Throws LogFileError when the disk is full; all
  /// messages since the last flush are then lost.
  void write(std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> bytes);
  /// Hands the written data to the system, so that it survives the process. Throws LogFileError.
  void flush();

  /// Flushes, then writes consecutive whole records as put_log_record() makes them; sets their
  /// numbers first. Throws LogFileError when the disk is full; then none of them is in the file.
  void write_records(std::span<std::uint8_t> records);

  std::int64_t messages() const { return messages_; }
  std::int64_t bytes() const { return bytes_; }  ///< Size of the file when flushed.
  /// The file, for another thread that syncs it to the disk.
  const std::shared_ptr<OpenLog>& file() const { return file_; }

  /// Bytes of one message in the file.
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
  std::int64_t number = 0;  ///< Number given by the writer.
  std::int64_t utime = 0;   ///< Time of receipt by the logger, CLOCK_REALTIME, µs.
  std::string channel;
  std::vector<std::uint8_t> bytes;  ///< Unchecked: use decode().
  std::int64_t offset = 0;          ///< Position of the record in the file.
};

/// A place in a log that belongs to no whole message.
struct LogDamage {
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
  std::string why;  ///< "the log ends within a message", …
};

/// Reads LCM logs of any size, whole or damaged, in constant memory. Behind damage it searches for
/// the next message, so that only damaged messages are lost, even if a damaged length points into,
/// or beyond, later messages. One thread.
class LogReader {
 public:
  /// Throws LogFileError without a file, or without a message in its first MiB.
  explicit LogReader(const std::filesystem::path& path);

  /// `on_damage` is called for every damaged place, before the message behind it is returned.
  void on_damage(std::function<void(const LogDamage&)> call) { on_damage_ = std::move(call); }

  /// Returns false at the end.
  bool next(LogRecord& record);

  std::int64_t size() const { return bytes_.size(); }            ///< Of the file, bytes.
  std::int64_t bytes_skipped() const { return bytes_skipped_; }  ///< Outside of whole messages.
  /// Description and offset of the first damaged place; nothing in a whole log.
  const std::optional<std::string>& damage() const { return damage_; }

 private:
  /// A range in which no message begins.
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
  // Caches, so that no range is searched twice: behind damage, and behind the claimed end of a
  // message.
  Searched behind_damage_;
  Searched behind_end_;
};

}  // namespace puck
