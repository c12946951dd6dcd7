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

/// Records of a log on their way from the thread of the bus to the thread that writes: a ring of
/// bytes, so that its memory is bounded whatever the messages are like, and a disk that stands
/// still costs the bus nothing. Messages are laid down as the file will hold them.
class LogQueue {
 public:
  explicit LogQueue(std::size_t capacity_bytes);

  /// False when it does not fit. Bus thread only.
  bool push(std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> message);
  /// Waits, up to `timeout` or a stop, until something is there. Writer thread only.
  void wait(std::stop_token stop, std::chrono::milliseconds timeout);
  /// The oldest records, whole ones, one after the other; empty when there are none. They stay
  /// there until release(). Writer thread only.
  std::span<std::uint8_t> front();
  /// The first `bytes` of front() are done with. Writer thread only.
  void release(std::size_t bytes);

  std::size_t bytes() const;       ///< Held now. Safe from any thread.
  std::size_t most_bytes() const;  ///< The most it ever held. Safe from any thread.

 private:
  /// Where `bytes` can be laid down; nothing when they do not fit.
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
