#include "common/runtime/packet_watch.h"

namespace puck {

void PacketWatch::expect(Timestamp last_event, Clock::time_point received) {
  const std::uint64_t end = end_.load(std::memory_order_relaxed);
  if (end - begin_.load(std::memory_order_acquire) >= kPackets) return;
  packets_[end % kPackets] = {last_event, received};
  end_.store(end + 1, std::memory_order_release);
}

void PacketWatch::answer(Timestamp newest_event, Clock::time_point now, LatencyHistogram& waits) {
  const std::uint64_t end = end_.load(std::memory_order_acquire);
  std::uint64_t begin = begin_.load(std::memory_order_relaxed);
  for (; begin < end && packets_[begin % kPackets].last_event <= newest_event; ++begin) {
    waits.record(std::chrono::duration_cast<std::chrono::microseconds>(
                     now - packets_[begin % kPackets].received)
                     .count());
  }
  begin_.store(begin, std::memory_order_release);
}

void PacketWatch::clear() {
  begin_.store(0, std::memory_order_relaxed);
  end_.store(0, std::memory_order_relaxed);
}

}  // namespace puck
