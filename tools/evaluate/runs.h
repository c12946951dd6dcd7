#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "common/io/event_reader.h"
#include "common/runtime/latency_histogram.h"
#include "common/vision/puck_estimate.h"
#include "tools/evaluate/tracker_setup.h"

namespace puck {

/// One answer of a tracker.
struct EvaluatedTick {
  Timestamp tick;  ///< The time that the answer is for.
  PuckEstimate estimate;
  std::optional<std::int64_t> latency_us;
  bool is_mark = false;  ///< The time is one of the `marks` of run_at_rate.
};
using OnTick = std::function<void(const EvaluatedTick&)>;

/// What a run tells besides its ticks; what its mode cannot measure is missing.
struct RunSummary {
  std::int64_t events = 0;
  Timestamp first;
  Timestamp last;
  double duration_s = 0;  ///< Sensor time from the first to the last event.
  std::optional<LatencySummary> latency;
  std::optional<double> throughput_mev_s;
  /// CPU time of the tracker, without the reading of the file, for each millisecond of sensor time.
  std::optional<double> cpu_us_per_ms;
};

/// Feeds the events up to each multiple of 1/rate of sensor time, and up to each of the `marks`
/// (which grow), and asks for an estimate there. Deterministic to the bit. Throws
/// std::runtime_error at a pause of more than an hour.
RunSummary run_at_rate(EventReader& events, const TrackerSetup& setup, double rate_hz,
                       const OnTick& on_tick, std::span<const Timestamp> marks = {});

/// Plays the events at the pace at which they were recorded and measures how long after its receipt
/// a packet's newest event is in an estimate. PUCK runs in its two threads, the other algorithms in
/// one. Ticks come from the tracking thread, one at a time. Throws std::runtime_error at a pause of
/// more than an hour.
RunSummary run_in_real_time(EventReader& events, const TrackerSetup& setup, const OnTick& on_tick);

/// Feeds the events as fast as they are taken, without a tick, and measures how many that is a
/// second. The time for reading the file does not count.
RunSummary run_as_fast_as_possible(EventReader& events, const TrackerSetup& setup);

}  // namespace puck
