#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace puck {

/// Hands the newest value from one thread to another. Nobody ever waits, wherever the other thread
/// is or hangs: there are three places, one of each thread and one between them, and both exchange
/// theirs for the one between.
template <typename Value>
class NewestValue {
 public:
  /// Writer only. To be filled before publish(); what it holds is any older value.
  Value& next() { return places_[writers_]; }
  /// Writer only. Whether the value before was never seen.
  bool publish() {
    // Released with what was written into it; acquired, since the reader is done with the other.
    const std::uint8_t before = between_.exchange(writers_ | kFresh, std::memory_order_acq_rel);
    writers_ = before & kPlace;
    return (before & kFresh) != 0;
  }

  /// Reader only. Whether there is a value that was not seen yet: seen() is that one then.
  bool look() {
    if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    readers_ = between_.exchange(readers_, std::memory_order_acq_rel) & kPlace;
    return true;
  }
  /// Reader only. As Value{} before the first.
  const Value& seen() const { return places_[readers_]; }

 private:
  static constexpr std::uint8_t kPlace = 3;
  static constexpr std::uint8_t kFresh = 4;

  std::array<Value, 3> places_{};
  std::uint8_t writers_ = 0;
  std::uint8_t readers_ = 1;
  std::atomic<std::uint8_t> between_{2};
};

}  // namespace puck
