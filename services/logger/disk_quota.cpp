#include "services/logger/disk_quota.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <tuple>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/messaging/log_format.h"
#include "common/posix/file_descriptor.h"

namespace puck {
namespace {

struct OldLog {
  std::int64_t changed_ns = 0;
  std::filesystem::path path;
  std::int64_t bytes = 0;

  bool operator<(const OldLog& other) const {
    return std::tie(changed_ns, path) < std::tie(other.changed_ns, other.path);
  }
};

bool begins_as_log(int descriptor, std::int64_t size) {
  if (size == 0) return true;
  std::array<std::uint8_t, kLogMark.size()> begin{};
  return pread(descriptor, begin.data(), begin.size(), 0) == static_cast<ssize_t>(begin.size()) &&
         begin == kLogMark;
}

/// Returns false for a file that must not be removed.
bool look_at(const std::filesystem::path& path, OldLog& log) {
  // Refuses links, and does not block on a pipe without a writer.
  const FileDescriptor file(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!file.is_open() || fstat(file.number(), &status) != 0) return false;
  if (!S_ISREG(status.st_mode) || !begins_as_log(file.number(), status.st_size)) return false;
  // The writer of a log holds its lock.
  if (flock(file.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  log.changed_ns = status.st_mtim.tv_sec * kNanoseconds + status.st_mtim.tv_nsec;
  log.bytes = status.st_size;
  log.path = path;
  return true;
}

}  // namespace

QuotaResult remove_oldest_logs(const LogNames& names, std::int64_t bytes) {
  std::vector<OldLog> logs;
  QuotaResult result;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(names.folder(), error), end;
       !error && entry != end; entry.increment(error)) {
    OldLog log;
    if (!names.is_ours(entry->path().filename()) || !look_at(entry->path(), log)) continue;
    result.bytes_left += log.bytes;
    logs.push_back(std::move(log));
  }
  if (error) result.problem = "cannot read " + names.folder().string() + ": " + error.message();
  std::sort(logs.begin(), logs.end());
  for (const OldLog& log : logs) {
    if (result.bytes_left <= bytes) break;
    if (unlink(log.path.c_str()) != 0) {
      result.problem =
          "cannot remove " + log.path.string() + ": " + std::generic_category().message(errno);
      continue;
    }
    ++result.files_removed;
    result.bytes_left -= log.bytes;
  }
  return result;
}

}  // namespace puck
