// Cost of a reader for the event thread: its time an event while another thread requests copies of
// the surface, against its time alone.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <stop_token>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/runtime/shared_surface.h"
#include "tests/bench/bench_streams.h"

namespace puck {
namespace {

using std::chrono::microseconds;

// A puck at middle distance with the room around it that the tracker asks for.
constexpr Region kRegion{200, 150, 150, 110};
constexpr microseconds kReaderPeriod{200};
constexpr std::size_t kPacketEvents = 8192;
// The rounds of a pair are compared with each other, so that a longer disturbance of the machine
// slows both.
constexpr int kPairs = 15;
constexpr std::size_t kPacketsARound = 400;

double thread_cpu_us() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

// The stream in packets; times start anew with each, so that they can be applied in any order.
std::vector<EventPacket> packets_of(const BenchEvents& stream) {
  std::vector<EventPacket> packets;
  const std::vector<Event>& events = stream.packet.events;
  for (std::size_t i = 0; i + kPacketEvents <= events.size(); i += kPacketEvents) {
    EventPacket packet{{0},
                       {events.begin() + static_cast<std::ptrdiff_t>(i),
                        events.begin() + static_cast<std::ptrdiff_t>(i + kPacketEvents)}};
    for (Event& event : packet.events) event.offset_us = 0;
    packets.push_back(std::move(packet));
  }
  return packets;
}

class Writer {
 public:
  Writer(SharedSurface& surface, std::vector<EventPacket> packets)
      : surface_(surface), packets_(std::move(packets)) {}

  // CPU time of this thread, µs.
  double round() {
    const double begin = thread_cpu_us();
    for (std::size_t i = 0; i < kPacketsARound; ++i) {
      surface_.update(packets_[next_], {});
      next_ = (next_ + 1) % packets_.size();
    }
    return thread_cpu_us() - begin;
  }

 private:
  SharedSurface& surface_;
  std::vector<EventPacket> packets_;
  std::size_t next_ = 0;
};

// Requests copies, as the tracking thread does.
class Reader {
 public:
  Reader(SharedSurface& surface, bool events)
      : thread_([&surface, events](const std::stop_token& stop) {
          SharedSnapshot snapshot;
          std::vector<Event> taken;
          taken.reserve(256);
          auto next = std::chrono::steady_clock::now();
          while (!stop.stop_requested()) {
            surface.snapshot(kRegion, events, snapshot);
            do {
              surface.pop_events(snapshot.events_end, 256, taken);
            } while (!taken.empty());
            next = std::max(next + kReaderPeriod, std::chrono::steady_clock::now());
            std::this_thread::sleep_until(next);
          }
        }) {}

 private:
  std::jthread thread_;
};

void compare(benchmark::State& state, bool events) {
  const BenchEvents stream = load(BenchStream::kScene);
  SharedSurface surface(stream.sensor, ErosParams{.half_width_px = 3, .decay = 0.786});
  SharedSnapshot snapshot;
  surface.snapshot(kRegion, false, snapshot);
  Writer writer(surface, packets_of(stream));
  writer.round();
  for (auto _ : state) {
    std::vector<double> slowdowns;
    double alone_us = 0;
    for (int pair = 0; pair < kPairs; ++pair) {
      const double alone = writer.round();
      alone_us += alone;
      {
        const Reader reader(surface, events);
        slowdowns.push_back(100 * (writer.round() / alone - 1));
      }
      surface.snapshot(kRegion, false, snapshot);
    }
    std::nth_element(slowdowns.begin(), slowdowns.begin() + kPairs / 2, slowdowns.end());
    state.counters["percent"] = slowdowns[kPairs / 2];
    state.SetIterationTime(alone_us * 1e-6);
  }
}

[[maybe_unused]] const bool registered = [] {
  benchmark::RegisterBenchmark("writer_slowdown/ours", compare, false)->UseManualTime();
  benchmark::RegisterBenchmark("writer_slowdown_with_events/ours", compare, true)->UseManualTime();
  return true;
}();

}  // namespace
}  // namespace puck
