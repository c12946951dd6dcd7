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

/// Reads a live source on a thread of its own, so that the camera behind it never has to wait. What
/// is not fetched in time is dropped, the oldest first, a whole chunk at a time, and counted: the
/// newest events are always at hand, in memory that does not grow.
///
/// The calls are for one thread.
class LiveSource final : public EventSource {
 public:
  /// Some 10 ms of the busiest stream that can be published.
  static constexpr std::size_t kChunks = 64;

  /// The source is called by the thread alone from now on. Throws std::invalid_argument when
  /// `most_chunks`, which the queue holds, is 0.
  explicit LiveSource(std::unique_ptr<EventSource> source, std::size_t most_chunks = kChunks);
  ~LiveSource() override;

  /// Throws what the source threw, once all before it has been fetched.
  Outcome next(Chunk& chunk) override;
  std::optional<SensorSize> sensor_size() const override { return told().sensor; }
  bool is_live() const override { return true; }
  std::string waiting_for() const override { return told().waiting_for; }
  std::int64_t events_dropped() const override;
  std::int64_t events_overflowed() const override;
  std::int64_t malformed_words() const override { return told().malformed_words; }
  std::vector<std::string> warnings() const override { return told().warnings; }

 private:
  /// What the source says of itself, as of its last chunk.
  struct Told {
    std::optional<SensorSize> sensor;
    std::string waiting_for;
    std::int64_t dropped = 0;
    std::int64_t malformed_words = 0;
    std::vector<std::string> warnings;
  };

  void read(std::stop_token stop);
  void push(Chunk& chunk);
  void drop_oldest();
  bool joins_newest(const Chunk& chunk) const;
  Told told() const;

  std::unique_ptr<EventSource> source_;  // The thread's.

  mutable std::mutex mutex_;  // Guards all below.
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
