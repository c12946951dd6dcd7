#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "common/events/timestamp.h"
#include "common/runtime/latency_histogram.h"

namespace puck {

/// Measures the latency of every event packet: from its receipt to the first estimate that includes
/// all of it, whether or not its events lie in the tracked region. Shared by the event thread and
/// the stepping thread (see SharedSurface); lock-free.
class PacketWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// Event thread only, before the packet is applied, in the order of `last_event`. Packets beyond
  /// kPackets waiting ones are not measured.
  void expect(Timestamp last_event, Clock::time_point received);

  /// Stepping thread only. An estimate that includes the events up to `newest_event` is published
  /// now. Records the latencies of the packets that it includes.
  void answer(Timestamp newest_event, Clock::time_point now, LatencyHistogram& waits);

  /// Drops all waiting packets. Only while neither thread runs.
  void clear();

 private:
  // Half a second, with a packet every 125 µs.
  static constexpr std::size_t kPackets = 4096;

  struct Packet {
    Timestamp last_event;
    Clock::time_point received;
  };

  std::array<Packet, kPackets> packets_{};
  // Positions in the stream of packets. Each is written by one thread at a time, with release after
  // that thread has written, or read, the entries before it; the other thread acquires it.
  std::atomic<std::uint64_t> end_{0};    // Event thread.
  std::atomic<std::uint64_t> begin_{0};  // Stepping thread.
};

}  // namespace puck
