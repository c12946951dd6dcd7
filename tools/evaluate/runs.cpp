#include "tools/evaluate/runs.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "common/io/event_cutter.h"
#include "common/runtime/latency_histogram.h"
#include "common/runtime/live_tracker.h"
#include "tools/evaluate/cpu_time.h"

namespace puck {
namespace {

using std::chrono::duration;
using std::chrono::duration_cast;
using std::chrono::microseconds;
using std::chrono::steady_clock;

// Short packets, as from a camera.
constexpr std::int64_t kLivePacketUs = 500;

// Counts events and their time span.
class Span {
 public:
  void add(const EventPacket& packet) {
    if (events_ == 0) first_ = packet.time_of(packet.events.front());
    last_ = packet.newest();
    events_ += static_cast<std::int64_t>(packet.events.size());
  }
  void write_to(RunSummary& summary) const {
    summary.events = events_;
    summary.first = first_;
    summary.last = last_;
    summary.duration_s = static_cast<double>(last_ - first_) * 1e-6;
  }

 private:
  std::int64_t events_ = 0;
  Timestamp first_;
  Timestamp last_;
};

std::int64_t us_since(steady_clock::time_point time) {
  return duration_cast<microseconds>(steady_clock::now() - time).count();
}

// Passes packets on when due on the host's clock.
template <typename TakePacket>
void play(EventReader& events, Span& span, const TakePacket& take) {
  EventCutter cutter(events);
  EventPacket piece;
  const auto first = cutter.next_time();
  if (!first) return;
  const auto begin = steady_clock::now();
  while (const auto next = cutter.next_time()) {
    cutter.take_until(*next + kLivePacketUs, piece);
    span.add(piece);
    std::this_thread::sleep_until(begin + microseconds(piece.newest() - *first));
    take(piece);
  }
}

}  // namespace

RunSummary run_at_rate(EventReader& events, const TrackerSetup& setup, double rate_hz,
                       const OnTick& on_tick, std::span<const Timestamp> marks) {
  const std::unique_ptr<TrackingAlgorithm> tracker = setup.make(events.sensor_size());
  const double period_us = 1e6 / rate_hz;
  EventCutter cutter(events);
  EventPacket piece;
  Span span;
  CpuTime cpu;
  std::int64_t number = 0;
  const auto tick_of = [&](std::int64_t n) {
    return Timestamp{std::llround(static_cast<double>(n) * period_us)};
  };
  auto next = cutter.next_time();
  auto mark = marks.begin();
  if (next) {
    number = static_cast<std::int64_t>(std::ceil(static_cast<double>(next->us) / period_us));
    mark = std::lower_bound(marks.begin(), marks.end(), *next);
  }
  while (next) {
    const Timestamp regular = tick_of(number);
    const bool is_mark = mark != marks.end() && *mark <= regular;
    const Timestamp tick = is_mark ? *mark : regular;
    while (next && *next <= tick) {
      cutter.take_until(tick, piece);
      cpu.of([&] { tracker->update(piece); });
      span.add(piece);
      next = cutter.next_time();
    }
    on_tick({tick, cpu.of([&] { return tracker->estimate(); }), std::nullopt, is_mark});
    if (is_mark) ++mark;
    if (tick == regular) ++number;
  }
  RunSummary summary;
  span.write_to(summary);
  if (summary.duration_s > 0) summary.cpu_us_per_ms = cpu.total_us() / (summary.duration_s * 1e3);
  return summary;
}

RunSummary run_in_real_time(EventReader& events, const TrackerSetup& setup, const OnTick& on_tick) {
  const SensorSize sensor = events.sensor_size();
  LatencyHistogram latencies;
  Span span;
  if (setup.algorithm == Algorithm::kPuck) {
    Timestamp newest{-1};
    LiveTracker tracker(sensor, setup.pipeline_params(), setup.size_model, {},
                        [&](const TrackedEstimate& tracked) {
                          // The first estimate has no events.
                          if (tracked.estimate.events_applied == 0) return;
                          if (tracked.estimate.newest_event <= newest) return;
                          newest = tracked.estimate.newest_event;
                          const std::int64_t latency = us_since(tracked.origin.received);
                          latencies.record(latency);
                          on_tick({newest, tracked.estimate, latency});
                        });
    play(events, span, [&](const EventPacket& packet) {
      tracker.update(packet, {.received = steady_clock::now()}, true);
    });
  } else {
    const std::unique_ptr<TrackingAlgorithm> tracker = setup.make(sensor);
    play(events, span, [&](const EventPacket& packet) {
      const auto received = steady_clock::now();
      tracker->update(packet);
      const PuckEstimate estimate = tracker->estimate();
      const std::int64_t latency = us_since(received);
      latencies.record(latency);
      on_tick({packet.newest(), estimate, latency});
    });
  }
  RunSummary summary;
  span.write_to(summary);
  summary.latency = latencies.summary();
  return summary;
}

RunSummary run_as_fast_as_possible(EventReader& events, const TrackerSetup& setup) {
  const SensorSize sensor = events.sensor_size();
  Span span;
  steady_clock::duration busy{};
  EventPacket packet;
  const auto feed = [&](const auto& take) {
    while (events.read(packet, EventReader::kUsualEvents)) {
      span.add(packet);
      const auto begin = steady_clock::now();
      take(packet);
      busy += steady_clock::now() - begin;
    }
  };
  if (setup.algorithm == Algorithm::kPuck) {
    LiveTracker tracker(sensor, setup.pipeline_params(), setup.size_model, {},
                        [](const TrackedEstimate&) {});
    feed([&](const EventPacket& p) { tracker.update(p, {}, true); });
  } else {
    const std::unique_ptr<TrackingAlgorithm> tracker = setup.make(sensor);
    feed([&](const EventPacket& p) {
      tracker->update(p);
      tracker->estimate();
    });
  }
  RunSummary summary;
  span.write_to(summary);
  const double seconds = duration<double>(busy).count();
  if (seconds > 0) {
    summary.throughput_mev_s = static_cast<double>(summary.events) / seconds * 1e-6;
  }
  return summary;
}

}  // namespace puck
