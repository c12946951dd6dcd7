#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <netinet/in.h>

#include "common/messaging/transport.h"

namespace puck {

/// Datagrams read from a socket before they are handled: many with one call, so that the socket's
/// small buffer stays empty. The memory is bounded and reserved at once; unused pages cost none.
/// One thread.
class DatagramQueue {
 public:
  /// Capacity in datagrams of the largest size; further ones wait in the socket.
  explicit DatagramQueue(std::size_t capacity);

  struct Entry {
    std::span<const std::uint8_t> bytes;
    Sender sender;
    std::int64_t utime = 0;  ///< The kernel's time stamp, CLOCK_REALTIME, µs; 0: none.
  };

  /// Reads up to 32 waiting datagrams that fit, without blocking. Returns their number.
  std::size_t fill(int socket);

  bool is_empty() const { return first_ == end_; }
  /// Whether another datagram waits behind the front.
  bool has_second() const { return end_ - first_ > 1; }
  Entry front() const;
  void pop() { ++first_; }

 private:
  static constexpr std::size_t kSlotBytes = 65'536;  // A datagram has 65,507 at most.
  static constexpr std::size_t kAtOnce = 32;

  struct Slot {
    sockaddr_in sender{};
    std::size_t size = 0;
    std::int64_t utime = 0;
  };

  std::uint8_t* bytes_of(std::size_t slot) const { return memory_.get() + slot * kSlotBytes; }

  std::size_t capacity_;
  std::unique_ptr<std::uint8_t[]> memory_;
  std::unique_ptr<Slot[]> slots_;
  // The datagrams are in slots first_ … end_ − 1. The empty queue starts again at 0, so that it
  // uses the same few pages.
  std::size_t first_ = 0;
  std::size_t end_ = 0;
};

}  // namespace puck
