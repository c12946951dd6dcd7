#include "common/messaging/queue_bound.h"

#include <algorithm>
#include <bit>

namespace puck {
namespace {

// The largest is forgotten by so much with every message: after a thousand small ones there is room
// for many of them, and a small one among large ones changes nothing.
constexpr std::size_t kForget = 256;

}  // namespace

bool QueueBound::add(std::size_t bytes) {
  largest_ = std::max(bytes, largest_ - largest_ / kForget);
  const int before = messages_;
  messages_ = messages_of(largest_);
  return messages_ != before;
}

// In powers of two, so that it stays the same while sizes hardly vary.
int QueueBound::messages_of(std::size_t bytes) const {
  const std::size_t room = most_bytes_ / std::bit_ceil(std::max<std::size_t>(bytes, 1));
  return static_cast<int>(
      std::clamp<std::size_t>(room, 1, static_cast<std::size_t>(most_messages_)));
}

}  // namespace puck
