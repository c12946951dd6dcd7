#include "common/io/peeked_bytes.h"

#include <algorithm>
#include <utility>

namespace puck {

PeekedBytes::PeekedBytes(std::unique_ptr<ByteSource> bytes, std::size_t length)
    : bytes_(std::move(bytes)), head_(length) {
  head_.resize(bytes_->read(head_));
}

std::size_t PeekedBytes::read(std::span<std::byte> bytes) {
  const std::size_t early = std::min(bytes.size(), head_.size() - head_used_);
  std::copy_n(head_.begin() + static_cast<std::ptrdiff_t>(head_used_), early, bytes.begin());
  head_used_ += early;
  // A source that gave less than the head's length has ended.
  return early == bytes.size() ? early : early + bytes_->read(bytes.subspan(early));
}

void PeekedBytes::rewind() {
  bytes_->rewind();
  head_.resize(bytes_->read(head_));
  head_used_ = 0;
}

}  // namespace puck
