#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string_view>

namespace puck {

/// Ring buffer of log records between the bus thread and the writer thread: bounded memory for any
/// messages, and no wait for a slow disk. Messages are stored in the format of the file.
class LogQueue {
 public:
  explicit LogQueue(std::size_t capacity_bytes);

  /// Returns false if it does not fit. Bus thread only.
  bool push(std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> message);
  /// Waits, up to `timeout` or a stop, for a record. Writer thread only.
  void wait(std::stop_token stop, std::chrono::milliseconds timeout);
  /// The oldest records, whole and contiguous; empty without any. Valid until release(). Writer
  /// thread only.
  std::span<std::uint8_t> front();
  /// Removes the first `bytes` of front(). Writer thread only.
  void release(std::size_t bytes);

  std::size_t bytes() const;       ///< Held now. Safe from any thread.
  std::size_t most_bytes() const;  ///< Maximum so far. Safe from any thread.

 private:
  /// Returns a contiguous range of `bytes`; null if they do not fit.
  std::uint8_t* reserve(std::size_t bytes);

  const std::size_t capacity_;
  const std::unique_ptr<std::uint8_t[]> ring_;
  mutable std::mutex mutex_;
  std::condition_variable_any arrived_;
  // All guarded by mutex_. Held: [begin_, end_), or [begin_, wrap_) and [0, end_) once wrapped.
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t wrap_ = 0;
  bool wrapped_ = false;
  std::size_t most_ = 0;
};

}  // namespace puck
