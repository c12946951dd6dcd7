#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "common/events/timestamp.h"
#include "common/runtime/latency_histogram.h"

namespace puck {

/// Measures how long every packet of events waits for its answer: from its receipt to the first
/// estimate that rests on all of it, whether any of its events lay in the region looked at or not.
/// The event thread and whoever makes the step (see SharedSurface) meet here; neither waits.
class PacketWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// Event thread only, before the packet is applied: `last_event` is its newest, in order. While
  /// kPackets of them wait for an answer no more are measured.
  void expect(Timestamp last_event, Clock::time_point received);

  /// By whoever makes the step: an estimate that rests on the events up to `newest_event` goes out
  /// now. Records the waits that end with it.
  void answer(Timestamp newest_event, Clock::time_point now, LatencyHistogram& waits);

  /// Forgets what waits. Only while neither thread runs.
  void clear();

 private:
  // Of half a second, with a packet every 125 µs.
  static constexpr std::size_t kPackets = 4096;

  struct Packet {
    Timestamp last_event;
    Clock::time_point received;
  };

  std::array<Packet, kPackets> packets_{};
  // Positions in the stream of packets. Each is written by one thread at a time, with release after
  // it has written, or read, what lies before; and acquired by the other.
  std::atomic<std::uint64_t> end_{0};    // event thread
  std::atomic<std::uint64_t> begin_{0};  // whoever makes the step
};

}  // namespace puck
