#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <lcm/eventlog.h>
#include <unistd.h>

#include "common/messaging/log_file.h"

namespace puck {
namespace {

// Of each message in the file: mark, number, time, two lengths.
constexpr std::int64_t kRecordHeaderBytes = 4 + 8 + 8 + 4 + 4;

std::string last_error() { return std::strerror(errno); }

/// Makes the file ours before LCM's writer, which would overwrite any, opens it.
void create(const std::filesystem::path& path, bool overwrite) {
  const int fd =
      open(path.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC | (overwrite ? 0 : O_EXCL), 0644);
  if (fd >= 0) {
    close(fd);
    return;
  }
  if (errno == EEXIST)
    throw LogFileError(path.string() + ": exists already and is not overwritten");
  throw LogFileError(path.string() + ": cannot be written: " + last_error());
}

}  // namespace

void LogWriter::Closer::operator()(lcm_eventlog_t* log) const { lcm_eventlog_destroy(log); }

LogWriter::LogWriter(const std::filesystem::path& path, bool overwrite) : path_(path) {
  create(path, overwrite);
  log_.reset(lcm_eventlog_create(path.c_str(), "w"));
  if (!log_) throw LogFileError(path.string() + ": cannot be written: " + last_error());
}

LogWriter::~LogWriter() = default;

void LogWriter::write(const std::string& channel, std::int64_t utime,
                      std::span<const std::uint8_t> bytes) {
  lcm_eventlog_event_t event{};
  event.timestamp = utime;
  event.channellen = static_cast<std::int32_t>(channel.size());
  event.datalen = static_cast<std::int32_t>(bytes.size());
  // LCM's C structure is not const; it only reads.
  event.channel = const_cast<char*>(channel.data());
  event.data = const_cast<std::uint8_t*>(bytes.data());
  if (lcm_eventlog_write_event(log_.get(), &event) != 0) {
    throw LogFileError(path_.string() + ": cannot be written: " + last_error());
  }
  ++messages_;
  bytes_ += record_bytes(channel, bytes.size());
}

void LogWriter::flush() {
  if (std::fflush(log_->f) != 0) {
    throw LogFileError(path_.string() + ": cannot be written: " + last_error());
  }
}

std::int64_t LogWriter::record_bytes(const std::string& channel, std::size_t message_bytes) {
  return kRecordHeaderBytes + static_cast<std::int64_t>(channel.size() + message_bytes);
}

}  // namespace puck
