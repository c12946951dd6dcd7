#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <netinet/in.h>

#include "common/messaging/transport.h"

namespace puck {

/// Datagrams taken from a socket before there is time to look at them: many with one call, so that
/// the socket's own small buffer stays empty. Its memory is bounded, and reserved at once; pages
/// that were never needed take none. One thread.
class DatagramQueue {
 public:
  /// So many of the largest datagrams fit; what comes beyond waits in the socket.
  explicit DatagramQueue(std::size_t capacity);

  struct Entry {
    std::span<const std::uint8_t> bytes;
    Sender sender;
    std::int64_t utime = 0;  ///< The kernel's stamp, CLOCK_REALTIME, µs; 0: none.
  };

  /// Takes what is there and fits, 32 at most, and does not wait. Returns how many.
  std::size_t fill(int socket);

  bool is_empty() const { return first_ == end_; }
  /// Whether another one waits behind the front.
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
  // The datagrams are those in slots first_ … end_ − 1. Empty, it begins again at 0: as long as it
  // keeps up, it works in the same few pages.
  std::size_t first_ = 0;
  std::size_t end_ = 0;
};

}  // namespace puck
