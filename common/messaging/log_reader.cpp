#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "common/messaging/byte_reader.h"
#include "common/messaging/log_file.h"

// LCM's own reader takes a damaged log for a finished one, so this is ours.

namespace puck {
namespace {

constexpr std::array<std::uint8_t, 4> kMark{0xed, 0xa1, 0xda, 0x01};
constexpr std::size_t kHeaderBytes = 4 + 8 + 8 + 4 + 4;
constexpr std::int64_t kMaxChannelBytes = 255;
constexpr std::int64_t kMaxMessageBytes = std::int64_t{1} << 28;  // LCM's own limit.

bool read_whole(std::FILE* file, void* to, std::size_t bytes) {
  return std::fread(to, 1, bytes, file) == bytes;
}

}  // namespace

void LogReader::Closer::operator()(std::FILE* file) const { std::fclose(file); }

LogReader::LogReader(const std::filesystem::path& path) {
  file_.reset(std::fopen(path.c_str(), "rb"));
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (!file_ || error) {
    const std::string why = error ? error.message() : std::strerror(errno);
    throw LogFileError(path.string() + ": cannot be read: " + why);
  }
  size_ = static_cast<std::int64_t>(size);
  std::array<std::uint8_t, kMark.size()> mark{};
  if (size_ > 0 && (!read_whole(file_.get(), mark.data(), mark.size()) || mark != kMark)) {
    throw LogFileError(path.string() + ": is not an LCM log: it does not begin with a message");
  }
}

LogReader::~LogReader() = default;

bool LogReader::next(LogRecord& record) {
  while (true) {
    std::string why;
    switch (read_record(record, why)) {
      case Outcome::kRecord:
        return true;
      case Outcome::kEnd:
        return false;
      case Outcome::kDamage:
        if (!damage_) damage_ = why + " at byte " + std::to_string(offset_);
        skip_to_next_record();
    }
  }
}

LogReader::Outcome LogReader::read_record(LogRecord& record, std::string& why) {
  if (offset_ >= size_) return Outcome::kEnd;
  std::fseek(file_.get(), static_cast<long>(offset_), SEEK_SET);
  std::array<std::uint8_t, kHeaderBytes> header{};
  why = "the log ends within a message";
  if (!read_whole(file_.get(), header.data(), header.size())) return Outcome::kDamage;
  if (!std::equal(kMark.begin(), kMark.end(), header.begin())) {
    why = "no message begins";
    return Outcome::kDamage;
  }
  ByteReader reader(header);
  reader.take(kMark.size());
  record.number = reader.whole<std::int64_t>();
  record.utime = reader.whole<std::int64_t>();
  const std::int64_t channel_bytes = reader.whole<std::int32_t>();
  const std::int64_t message_bytes = reader.whole<std::int32_t>();
  if (channel_bytes < 1 || channel_bytes > kMaxChannelBytes || message_bytes < 0 ||
      message_bytes > kMaxMessageBytes) {
    why = "a message has an impossible length";
    return Outcome::kDamage;
  }
  const std::int64_t end =
      offset_ + static_cast<std::int64_t>(kHeaderBytes) + channel_bytes + message_bytes;
  if (end > size_) return Outcome::kDamage;
  record.channel.resize(static_cast<std::size_t>(channel_bytes));
  record.bytes.resize(static_cast<std::size_t>(message_bytes));
  if (!read_whole(file_.get(), record.channel.data(), record.channel.size()) ||
      !read_whole(file_.get(), record.bytes.data(), record.bytes.size())) {
    return Outcome::kDamage;
  }
  offset_ = end;
  return Outcome::kRecord;
}

void LogReader::skip_to_next_record() {
  std::array<std::uint8_t, 65536> block{};
  const std::int64_t from = offset_;
  ++offset_;
  while (offset_ < size_) {
    std::fseek(file_.get(), static_cast<long>(offset_), SEEK_SET);
    const std::size_t count = std::fread(block.data(), 1, block.size(), file_.get());
    const auto end = block.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::search(block.begin(), end, kMark.begin(), kMark.end());
    if (found != end) {
      offset_ += found - block.begin();
      break;
    }
    if (count < kMark.size()) {
      offset_ = size_;
      break;
    }
    // The mark may lie across two blocks.
    offset_ += static_cast<std::int64_t>(count - kMark.size() + 1);
  }
  bytes_skipped_ += std::min(offset_, size_) - from;
}

}  // namespace puck
