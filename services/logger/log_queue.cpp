#include "services/logger/log_queue.h"

#include <algorithm>

#include "common/messaging/log_format.h"

namespace puck {

// The system provides the ring's memory only when it is used.
LogQueue::LogQueue(std::size_t capacity_bytes)
    : capacity_(capacity_bytes),
      ring_(std::make_unique_for_overwrite<std::uint8_t[]>(capacity_bytes)) {}

bool LogQueue::push(std::string_view channel, std::int64_t utime,
                    std::span<const std::uint8_t> message) {
  // The writer sets the number, which depends on the file.
  const LogHeader header{0, utime, channel.size(), message.size()};
  std::uint8_t* const place = reserve(header.record_bytes());
  if (place == nullptr) return false;
  // Outside the lock: no other thread sees this range yet.
  put_log_record({place, header.record_bytes()}, header, channel, message);
  bool was_empty = false;
  {
    const std::lock_guard lock(mutex_);
    was_empty = !wrapped_ && begin_ == end_;
    if (place == ring_.get() && end_ != 0) {
      wrap_ = end_;
      wrapped_ = true;
      end_ = 0;
      if (begin_ == wrap_) {  // All data before the wrap was released meanwhile.
        begin_ = 0;
        wrapped_ = false;
      }
    }
    end_ += header.record_bytes();
    const std::size_t held = wrapped_ ? wrap_ - begin_ + end_ : end_ - begin_;
    most_ = std::max(most_, held);
  }
  if (was_empty) arrived_.notify_one();
  return true;
}

std::uint8_t* LogQueue::reserve(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (!wrapped_ && begin_ == end_) begin_ = end_ = 0;
  if (wrapped_) return end_ + bytes <= begin_ ? ring_.get() + end_ : nullptr;
  if (end_ + bytes <= capacity_) return ring_.get() + end_;
  // A record is contiguous, so the rest of the ring's end stays unused.
  return bytes <= begin_ ? ring_.get() : nullptr;
}

void LogQueue::wait(std::stop_token stop, std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, stop, timeout, [this] { return wrapped_ || begin_ != end_; });
}

std::span<std::uint8_t> LogQueue::front() {
  const std::lock_guard lock(mutex_);
  return {ring_.get() + begin_, (wrapped_ ? wrap_ : end_) - begin_};
}

void LogQueue::release(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  begin_ += bytes;
  if (wrapped_ && begin_ == wrap_) {
    begin_ = 0;
    wrapped_ = false;
  }
}

std::size_t LogQueue::bytes() const {
  const std::lock_guard lock(mutex_);
  return wrapped_ ? wrap_ - begin_ + end_ : end_ - begin_;
}

std::size_t LogQueue::most_bytes() const {
  const std::lock_guard lock(mutex_);
  return most_;
}

}  // namespace puck
