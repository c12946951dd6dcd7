#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <thread>

#include "services/logger/log_queue.h"

namespace puck {

/// Passes messages from the bus thread to a writer on its own thread, so that the bus never waits
/// for a disk.
class LogThread {
 public:
  /// Writes the first of the given whole records, at least one, and returns their bytes. Writer
  /// thread only. Must not throw.
  using Write = std::function<std::size_t(std::span<std::uint8_t> records)>;

  LogThread(std::size_t queue_bytes, Write write);

  /// Returns false if it does not fit into the queue. Bus thread only.
  bool push(std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> message) {
    return queue_.push(channel, utime, message);
  }
  /// Returns when all pushed messages are written. Push nothing afterwards.
  void finish();

  const LogQueue& queue() const { return queue_; }

 private:
  void run(const std::stop_token& stop);
  void write_all();

  LogQueue queue_;
  Write write_;
  std::jthread thread_;  // Last, so that it ends before what it uses.
};

}  // namespace puck
