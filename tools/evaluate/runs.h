#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "common/io/event_reader.h"
#include "common/runtime/latency_histogram.h"
#include "common/trackers/tracker_setup.h"
#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

/// One estimate of a tracker.
struct EvaluatedTick {
  Timestamp tick;  ///< Time of the query.
  PuckEstimate estimate;
  std::optional<std::int64_t> latency_us;
  bool is_mark = false;  ///< At one of the `marks` of run_at_rate.
};
using OnTick = std::function<void(const EvaluatedTick&)>;

/// Results of a run besides its ticks; empty if its mode cannot measure them.
struct RunSummary {
  std::int64_t events = 0;
  Timestamp first;
  Timestamp last;
  double duration_s = 0;  ///< Sensor time from the first to the last event.
  std::optional<LatencySummary> latency;
  std::optional<double> throughput_mev_s;
  /// CPU time of the tracker, without reading the file, per millisecond of sensor time.
  std::optional<double> cpu_us_per_ms;
};

/// Feeds the events up to each multiple of 1/rate of sensor time and up to each of the ascending
/// `marks`, and asks for an estimate there. Deterministic to the bit. Throws std::runtime_error at
/// a pause of more than an hour.
RunSummary run_at_rate(EventReader& events, const TrackerSetup& setup, double rate_hz,
                       const OnTick& on_tick, std::span<const Timestamp> marks = {});

/// Plays the events at the recorded pace and measures the latency from a packet's receipt to an
/// estimate with its newest event. PUCK runs in its two threads, the other algorithms in one. Ticks
/// come from the tracking thread, one at a time. Throws std::runtime_error at a pause of more than
/// an hour.
RunSummary run_in_real_time(EventReader& events, const TrackerSetup& setup, const OnTick& on_tick);

/// Feeds the events as fast as possible, without ticks, and measures events per second without the
/// time for reading the file.
RunSummary run_as_fast_as_possible(EventReader& events, const TrackerSetup& setup);

}  // namespace puck
