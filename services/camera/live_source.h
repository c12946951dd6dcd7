#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "services/camera/event_source.h"

namespace puck {

/// Reads a live source on its own thread, so that the camera behind it never waits. Chunks that are
/// not fetched in time are dropped, the oldest first, and counted: the newest events are always
/// available, in bounded memory.
///
/// Call it from one thread.
class LiveSource final : public EventSource {
 public:
  /// Some 10 ms of the fastest stream that can be published.
  static constexpr std::size_t kChunks = 64;

  /// From now on only the thread calls the source. Throws std::invalid_argument if `most_chunks`,
  /// the capacity of the queue, is 0.
  explicit LiveSource(std::unique_ptr<EventSource> source, std::size_t most_chunks = kChunks);
  ~LiveSource() override;

  /// Throws the source's exception after all earlier chunks were fetched.
  Outcome next(Chunk& chunk) override;
  std::optional<SensorSize> sensor_size() const override { return told().sensor; }
  std::string waiting_for() const override { return told().waiting_for; }
  std::int64_t events_dropped() const override;
  std::int64_t events_overflowed() const override;
  std::int64_t malformed_words() const override;
  std::optional<PortCounts> port_counts() const override;
  std::vector<std::string> warnings() const override { return told().warnings; }

 private:
  /// The source's own counters and texts, as of its last chunk.
  struct Told {
    std::optional<SensorSize> sensor;
    std::string waiting_for;
    std::int64_t dropped = 0;
    std::int64_t malformed_words = 0;
    std::optional<PortCounts> port;
    std::vector<std::string> warnings;
  };

  void read(std::stop_token stop);
  void push(Chunk& chunk);
  void drop_oldest();
  bool joins_newest(const Chunk& chunk) const;
  Told told() const;

  std::unique_ptr<EventSource> source_;  // Used by the thread only.

  mutable std::mutex mutex_;  // Guards all members below.
  std::condition_variable came_;
  std::vector<Chunk> ring_;
  std::size_t oldest_ = 0;
  std::size_t count_ = 0;
  std::int64_t overflowed_ = 0;
  Told told_;
  bool has_ended_ = false;
  std::exception_ptr failure_;

  std::jthread thread_;  // Last, so that it ends first.
};

}  // namespace puck
