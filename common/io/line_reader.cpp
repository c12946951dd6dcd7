#include "common/io/line_reader.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace puck {
namespace {

constexpr std::size_t kUsualLineBlock = 65536;

}  // namespace

LineReader::LineReader(ByteSource& bytes, std::size_t longest)
    : source_(bytes), longest_(longest), buffer_(kUsualLineBlock) {}

std::optional<std::string_view> LineReader::next() {
  std::size_t searched = 0;
  while (true) {
    const char* const line = buffer_.data() + used_;
    const std::size_t length = size_ - used_;
    const void* const end = std::memchr(line + searched, '\n', length - searched);
    if (end != nullptr) {
      const auto line_length = static_cast<std::size_t>(static_cast<const char*>(end) - line);
      used_ += line_length + 1;
      is_whole_ = true;
      searched = 0;
      if (!std::exchange(is_in_skipped_, false)) return std::string_view(line, line_length);
      continue;
    }
    searched = length;
    if (length >= longest_) {
      if (!is_in_skipped_) ++skipped_;
      is_in_skipped_ = true;
      used_ = size_;
      searched = 0;
    }
    if (refill()) continue;
    used_ = size_;
    is_whole_ = false;
    if (length == 0 || std::exchange(is_in_skipped_, false)) return std::nullopt;
    return std::string_view(buffer_.data() + size_ - length, length);
  }
}

void LineReader::restart() {
  used_ = 0;
  size_ = 0;
  bytes_before_ = 0;
  is_whole_ = true;
  is_in_skipped_ = false;
  skipped_ = 0;
}

// Moves the rest to the front and reads behind it. Returns false at the end of the source.
bool LineReader::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(used_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
  bytes_before_ += static_cast<std::int64_t>(used_);
  size_ -= used_;
  used_ = 0;
  if (size_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
  const std::size_t more = source_.read(std::as_writable_bytes(std::span(buffer_).subspan(size_)));
  size_ += more;
  return more > 0;
}

}  // namespace puck
