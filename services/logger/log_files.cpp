#include "services/logger/log_files.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <utility>

#include "services/logger/disk_quota.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

// Size of one write(2): the most that is torn when the process is killed.
constexpr std::size_t kLargestWrite = std::size_t{1} << 20;
constexpr std::chrono::seconds kRetry{1};

LogHeader header_of(std::span<const std::uint8_t> records) {
  const auto header = parse_log_header(records);
  if (!header || header->record_bytes() > records.size()) {
    throw std::invalid_argument("the log queue holds bytes that are not a record");
  }
  return *header;
}

}  // namespace

LogFiles::LogFiles(const LoggerParams& params, std::string_view prefix, LogSync& sync)
    : params_(params), sync_(sync), not_written_(prefix) {
  const std::time_t start = std::time(nullptr);
  const std::filesystem::path path = expand_log_path(params_.path, start);
  folder_ = path.has_parent_path() ? path.parent_path() : ".";
  if (params_.rotates()) {
    names_.emplace(params_.path, path);
    begin_rotated_file();
  } else {
    begin_first_file(start);
  }
}

// A killed logger may be started again in the same second, and so with the same file name.
void LogFiles::begin_first_file(std::time_t start) {
  const std::filesystem::path first = expand_log_path(params_.path, start);
  if (!params_.overwrite && expand_log_path(params_.path, start + 1) != first) {
    while (std::filesystem::exists(first) && std::time(nullptr) <= start) {
      std::this_thread::sleep_for(milliseconds(10));
    }
  }
  const std::filesystem::path path = expand_log_path(params_.path, std::time(nullptr));
  writer_ = std::make_unique<LogWriter>(path, params_.overwrite);
  progress_.path = path;
  progress_.files = 1;
}

void LogFiles::begin_rotated_file() {
  if (writer_) {
    messages_before_ += writer_->messages();
    bytes_before_ += writer_->bytes();
    writer_.reset();  // Closed before the next one is opened.
  }
  QuotaResult quota;
  if (params_.quota_bytes > 0) {
    quota = remove_oldest_logs(*names_, params_.quota_bytes - params_.rotate_bytes);
  }
  next_number_ = std::max(next_number_, names_->first_free());
  const std::filesystem::path path = names_->at(next_number_);
  writer_ = std::make_unique<LogWriter>(path);
  const std::lock_guard lock(mutex_);
  progress_.path = path;
  ++progress_.files;
  progress_.files_removed += quota.files_removed;
  progress_.quota_problem = quota.problem;
}

std::size_t LogFiles::write(std::span<std::uint8_t> records) {
  try {
    if (!writer_ && Clock::now() >= next_try_) begin_rotated_file();
    if (writer_ && !is_full_ && belongs_into_next_file(header_of(records), 0)) {
      begin_rotated_file();
    }
  } catch (const LogFileError& error) {
    next_try_ = Clock::now() + kRetry;
    stop_for(error.what());
  }
  if (writer_ && writer_->messages() == 0) file_began_utime_ = header_of(records).utime;
  const auto run = records.first(run_of(records));
  if (const auto problem = obstacle(run.size())) {
    stop_for(*problem);
    discard(run);
    return run.size();
  }
  try {
    writer_->write_records(run);
    sync_.request(writer_->file());
    note_written();
  } catch (const LogFileError& error) {
    next_try_ = Clock::now() + kRetry;
    stop_for(error.what());
    discard(run);
  }
  return run.size();
}

std::size_t LogFiles::run_of(std::span<const std::uint8_t> records) const {
  std::size_t bytes = 0;
  while (bytes < records.size()) {
    const LogHeader header = header_of(records.subspan(bytes));
    const std::size_t with_this = bytes + header.record_bytes();
    const bool ends = with_this > kLargestWrite || (!is_full_ && exceeds_max(with_this)) ||
                      (writer_ && belongs_into_next_file(header, bytes));
    if (bytes > 0 && ends) break;
    bytes = with_this;
  }
  return bytes;
}

bool LogFiles::exceeds_max(std::size_t run_bytes) const {
  const std::int64_t written = bytes_before_ + (writer_ ? writer_->bytes() : 0);
  return params_.max_bytes > 0 &&
         written + static_cast<std::int64_t>(run_bytes) > params_.max_bytes;
}

bool LogFiles::belongs_into_next_file(const LogHeader& header, std::size_t run_bytes) const {
  if (!params_.rotates() || (writer_->messages() == 0 && run_bytes == 0)) return false;
  const std::int64_t with_this =
      writer_->bytes() + static_cast<std::int64_t>(run_bytes + header.record_bytes());
  if (params_.rotate_bytes > 0 && with_this > params_.rotate_bytes) return true;
  // Absolute: after a clock was set back, a file must not last until it has caught up.
  return params_.rotate_s > 0 &&
         std::abs(header.utime - file_began_utime_) >= 1'000'000 * params_.rotate_s;
}

/// Reason why `bytes` cannot be written now.
std::optional<std::string> LogFiles::obstacle(std::size_t bytes) {
  is_full_ = is_full_ || exceeds_max(bytes);
  if (is_full_) {
    return "logger.max_bytes = " + std::to_string(params_.max_bytes) + " is reached";
  }
  if (Clock::now() < next_try_) return progress().problem;
  if (!writer_) return "no file is open";
  if (params_.min_free_bytes == 0) return std::nullopt;
  std::error_code error;
  const std::uintmax_t available = std::filesystem::space(folder_, error).available;
  if (error) {
    next_try_ = Clock::now() + kRetry;
    return "cannot tell how much is free in " + folder_.string() + ": " + error.message();
  }
  if (available < static_cast<std::uintmax_t>(params_.min_free_bytes) + bytes) {
    next_try_ = Clock::now() + kRetry;
    return "less than logger.min_free_bytes = " + std::to_string(params_.min_free_bytes) +
           " is free in " + folder_.string();
  }
  return std::nullopt;
}

void LogFiles::discard(std::span<const std::uint8_t> records) {
  const std::lock_guard lock(mutex_);
  while (!records.empty()) {
    const LogHeader header = header_of(records);
    const auto channel = records.subspan(kLogHeaderBytes, header.channel_bytes);
    not_written_.add({reinterpret_cast<const char*>(channel.data()), channel.size()});
    records = records.subspan(header.record_bytes());
  }
}

void LogFiles::stop_for(std::string problem) {
  const std::lock_guard lock(mutex_);
  progress_.problem = std::move(problem);
}

void LogFiles::note_written() {
  const std::lock_guard lock(mutex_);
  progress_.messages = messages_before_ + writer_->messages();
  progress_.bytes = bytes_before_ + writer_->bytes();
  progress_.problem.reset();
}

LogProgress LogFiles::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

ChannelTally LogFiles::not_written() const {
  const std::lock_guard lock(mutex_);
  return not_written_;
}

}  // namespace puck
