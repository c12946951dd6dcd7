#include "common/io/compressed_bytes.h"

#include <utility>

#include "common/io/event_reader.h"

namespace puck {
namespace {

constexpr std::size_t kPackedBlockBytes = 65536;

}  // namespace

CompressedBytes::CompressedBytes(std::unique_ptr<ByteSource> packed)
    : packed_(std::move(packed)), block_(kPackedBlockBytes) {}

std::size_t CompressedBytes::read(std::span<std::byte> bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size() && fault_.empty()) {
    if (block_used_ == block_size_) {
      bytes_before_ += static_cast<std::int64_t>(block_size_);
      block_used_ = 0;
      block_size_ = packed_->read(block_);
    }
    const Step step = unpack(std::span(block_).subspan(block_used_, block_size_ - block_used_),
                             bytes.subspan(filled));
    block_used_ += step.taken;
    filled += step.given;
    if (step.taken > 0 || step.given > 0) is_between_parts_ = step.is_between_parts;
    fault_ = step.fault;
    if (fault_.empty() && block_size_ == 0 && step.given == 0) {
      if (is_between_parts_) return filled;
      fault_ = "end too early, within their compressed data";
    }
  }
  if (filled == 0 && !fault_.empty()) {
    throw EventFileError(name() + ": cannot be read to its end: its bytes " + fault_ +
                         ", at byte " +
                         std::to_string(bytes_before_ + static_cast<std::int64_t>(block_used_)));
  }
  return filled;
}

void CompressedBytes::rewind() {
  packed_->rewind();
  restart();
  block_used_ = 0;
  block_size_ = 0;
  bytes_before_ = 0;
  is_between_parts_ = true;
  fault_.clear();
}

}  // namespace puck
