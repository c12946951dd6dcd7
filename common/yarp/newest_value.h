#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace puck {

/// Passes the newest value from one thread to another, wait-free (triple buffer): each thread has a
/// buffer, and exchanges it with the third one between them.
template <typename Value>
class NewestValue {
 public:
  /// Writer only. The buffer to fill before publish(); it holds any older value.
  Value& next() { return buffers_[writers_]; }
  /// Writer only. Returns whether the previous value was never seen.
  bool publish() {
    // Release: publishes the contents. Acquire: the reader has finished with the other buffer.
    const std::uint8_t before = between_.exchange(writers_ | kFresh, std::memory_order_acq_rel);
    writers_ = before & kPlace;
    return (before & kFresh) != 0;
  }

  /// Reader only. Whether there is a new value; seen() then returns it.
  bool look() {
    if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    readers_ = between_.exchange(readers_, std::memory_order_acq_rel) & kPlace;
    return true;
  }
  /// Reader only. Value{} before the first.
  const Value& seen() const { return buffers_[readers_]; }

 private:
  static constexpr std::uint8_t kPlace = 3;
  static constexpr std::uint8_t kFresh = 4;

  std::array<Value, 3> buffers_{};
  std::uint8_t writers_ = 0;
  std::uint8_t readers_ = 1;
  std::atomic<std::uint8_t> between_{2};
};

}  // namespace puck
