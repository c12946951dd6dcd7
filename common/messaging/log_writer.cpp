#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "common/messaging/log_file.h"

// LCM's own writer uses stdio, which does not report how much of a failed write is in the file;
// hence this one.

namespace puck {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

LogFileError write_error(const std::filesystem::path& path) {
  return LogFileError(path.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace

OpenLog::OpenLog(const std::filesystem::path& path, bool overwrite) : path_(path) {
  const int exclusive = overwrite ? 0 : O_EXCL;
  file_ = FileDescriptor(
      open(path.c_str(), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC | exclusive, 0644));
  if (!file_.is_open()) {
    if (errno == EEXIST) {
      throw LogFileError(path.string() + ": exists already and is not overwritten");
    }
    throw write_error(path);
  }
  // Logging also works on a file system without locks.
  if (flock(descriptor(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw LogFileError(path.string() + ": cannot be written: another logger writes it");
  }
  if (ftruncate(descriptor(), 0) != 0) throw write_error(path);
}

void OpenLog::unlock() { flock(descriptor(), LOCK_UN); }

void OpenLog::put_on_disk() {
  if (fdatasync(descriptor()) != 0) throw write_error(path_);
  if (name_is_on_disk_) return;
  const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
  const FileDescriptor opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened.is_open() || fsync(opened.number()) != 0) throw write_error(folder);
  name_is_on_disk_ = true;
}

LogWriter::LogWriter(const std::filesystem::path& path, bool overwrite)
    : file_(std::make_shared<OpenLog>(path, overwrite)) {
  buffer_.reserve(kBufferBytes);
}

LogWriter::~LogWriter() {
  try {
    flush();
  } catch (const LogFileError&) {  // A caller that needs the error flushes first.
  }
  file_->unlock();
}

void LogWriter::write(std::string_view channel, std::int64_t utime,
                      std::span<const std::uint8_t> bytes) {
  const LogHeader header{messages_, utime, channel.size(), bytes.size()};
  if (buffer_.size() + header.record_bytes() > kBufferBytes) flush();
  const std::size_t at = buffer_.size();
  buffer_.resize(at + header.record_bytes());
  put_log_record(std::span(buffer_).subspan(at), header, channel, bytes);
  ++messages_;
  ++buffered_messages_;
  bytes_ += static_cast<std::int64_t>(header.record_bytes());
}

void LogWriter::flush() {
  if (buffer_.empty()) return;
  std::vector<std::uint8_t> written = std::move(buffer_);
  const std::int64_t messages = buffered_messages_;
  buffer_.clear();
  buffered_messages_ = 0;
  try {
    write_whole(written);
  } catch (const LogFileError&) {
    messages_ -= messages;
    bytes_ = bytes_in_file_;
    throw;
  }
  written.clear();
  buffer_ = std::move(written);  // Reuses its memory.
}

void LogWriter::write_records(std::span<std::uint8_t> records) {
  flush();
  std::int64_t messages = messages_;
  for (auto left = records; !left.empty(); ++messages) {
    const auto header = parse_log_header(left);
    if (!header || header->record_bytes() > left.size()) {
      throw std::invalid_argument("LogWriter takes only whole records");
    }
    put_log_number(left, messages);
    left = left.subspan(header->record_bytes());
  }
  write_whole(records);
  messages_ = messages;
  bytes_ = bytes_in_file_;
}

void LogWriter::write_whole(std::span<const std::uint8_t> bytes) {
  const int descriptor = file_->descriptor();
  for (auto left = bytes; !left.empty();) {
    const ssize_t count = ::write(descriptor, left.data(), left.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const LogFileError error = write_error(file_->path());
      // Back to the end of the last whole message. If that fails, readers skip the torn one.
      [[maybe_unused]] const int cut = ftruncate(descriptor, static_cast<off_t>(bytes_in_file_));
      throw error;
    }
    left = left.subspan(static_cast<std::size_t>(count));
  }
  bytes_in_file_ += static_cast<std::int64_t>(bytes.size());
}

std::int64_t LogWriter::record_bytes(std::string_view channel, std::size_t message_bytes) {
  return static_cast<std::int64_t>(LogHeader{0, 0, channel.size(), message_bytes}.record_bytes());
}

}  // namespace puck
