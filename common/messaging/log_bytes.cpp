#include "common/messaging/log_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/messaging/log_file.h"
#include "common/messaging/log_format.h"

namespace puck {
namespace {

constexpr std::size_t kWindowBytes = std::size_t{1} << 20;

}  // namespace

LogBytes::LogBytes(const std::filesystem::path& path)
    // Opening a pipe without a writer must not block; it is refused below.
    : file_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  struct stat status {};
  if (!file_.is_open() || fstat(file_.number(), &status) != 0) {
    throw LogFileError(path.string() + ": cannot be read: " + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    throw LogFileError(path.string() + ": cannot be read: is not a file");
  }
  size_ = status.st_size;
}

std::span<const std::uint8_t> LogBytes::at(std::int64_t offset, std::size_t count) {
  const auto window_end = [&] {
    return window_offset_ + static_cast<std::int64_t>(window_.size());
  };
  count = static_cast<std::size_t>(
      std::clamp<std::int64_t>(size_ - offset, 0, static_cast<std::int64_t>(count)));
  if (offset < window_offset_ || offset + static_cast<std::int64_t>(count) > window_end()) {
    fill(offset, count);
    count = std::min(count, window_.size());
  }
  if (count == 0) return {};
  return std::span<const std::uint8_t>(window_).subspan(
      static_cast<std::size_t>(offset - window_offset_), count);
}

std::span<const std::uint8_t> LogBytes::peek(std::int64_t offset, std::size_t count) {
  count = std::min(count, peeked_.size());
  const std::int64_t window_end = window_offset_ + static_cast<std::int64_t>(window_.size());
  if (offset >= window_offset_ && offset + static_cast<std::int64_t>(count) <= window_end) {
    return at(offset, count);
  }
  if (offset >= size_) return {};
  const auto left = static_cast<std::size_t>(size_ - offset);
  ssize_t got = 0;
  do {
    got = pread(file_.number(), peeked_.data(), std::min(count, left), static_cast<off_t>(offset));
  } while (got < 0 && errno == EINTR);
  return std::span(peeked_).first(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
}

void LogBytes::fill(std::int64_t offset, std::size_t count) {
  // Frees the memory of a large message that is no longer needed.
  if (window_.capacity() > kWindowBytes && count <= kWindowBytes) {
    std::vector<std::uint8_t>().swap(window_);
  }
  const auto left = static_cast<std::size_t>(std::max<std::int64_t>(size_ - offset, 0));
  window_.resize(std::min(std::max(count, kWindowBytes), left));
  window_offset_ = offset;
  std::size_t filled = 0;
  while (filled < window_.size()) {
    const ssize_t got = pread(file_.number(), window_.data() + filled, window_.size() - filled,
                              static_cast<off_t>(offset) + static_cast<off_t>(filled));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    filled += static_cast<std::size_t>(got);
  }
  if (filled < count) size_ = offset + static_cast<std::int64_t>(filled);
  window_.resize(filled);
}

std::int64_t LogBytes::find_mark(std::int64_t from, std::int64_t to) {
  constexpr std::size_t kOverlap = kLogMark.size() - 1;
  while (from < to) {
    const auto most = static_cast<std::size_t>(to - from) + kOverlap;
    // Bytes already in the window are searched first, without moving it.
    const std::int64_t end = window_offset_ + static_cast<std::int64_t>(window_.size());
    const bool inside =
        from >= window_offset_ && from + static_cast<std::int64_t>(kLogMark.size()) <= end;
    const auto block =
        at(from, std::min(most, inside ? static_cast<std::size_t>(end - from) : kWindowBytes));
    if (block.size() <= kOverlap) break;
    const void* found = memmem(block.data(), block.size(), kLogMark.data(), kLogMark.size());
    if (found != nullptr) {
      const auto place = static_cast<const std::uint8_t*>(found) - block.data();
      return std::min<std::int64_t>(from + place, to);
    }
    // The mark may lie across two blocks.
    from += static_cast<std::int64_t>(block.size() - kOverlap);
  }
  return to;
}

}  // namespace puck
