#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/runtime/latency_histogram.h"
#include "tests/bench/live/live_system.h"

namespace puck {

/// A run at one rate: what the camera sent, and what became of it.
struct TransportRun {
  double wanted_mev_s = 0;
  double sent_mev_s = 0;  ///< In fact, by the host's clock.
  std::int64_t events_sent = 0;
  std::int64_t lost_on_the_way = 0;     ///< Sent but not received.
  std::int64_t counted_by_tracker = 0;  ///< As lost, from gaps in the packets' numbers.
  std::int64_t skipped = 0;  ///< Received too late to be of use, and dropped by the tracker.
  std::int64_t thinned = 0;  ///< On the surface, but not handed over singly.
  std::int64_t late_us = 0;  ///< What the camera gave up of the sensor's pace.
  CpuLoad cpu;

  std::int64_t lost() const { return lost_on_the_way + skipped; }
  bool lost_nothing() const { return lost() == 0 && counted_by_tracker == 0; }
  /// Whether the camera sent as fast as was asked for.
  bool kept_pace() const;
  /// Then a higher rate is worth a try.
  bool carried_all() const { return lost_nothing() && kept_pace(); }
};

/// What sealing all messages with a key costs.
struct KeyCost {
  struct Side {
    /// Of a core, all services together, for what was sent scaled to the rate; of the best run. 0:
    /// none yet.
    double cpu_percent = 0;
    std::int64_t lost = 0;  ///< Events, in all runs.

    void add(const TransportRun& run);
  };

  double rate_mev_s = 0;
  int packet_bytes = 0;
  Side plain;
  Side sealed;

  /// How much more with a key than without.
  double percent() const { return 100 * (sealed.cpu_percent / plain.cpu_percent - 1); }
};

/// The tracker under more events than it can take.
struct FloodRun {
  double sent_mev_s = 0;
  double taken_mev_s = 0;  ///< On the surface in fact.
  std::int64_t skipped = 0;
  std::int64_t lost = 0;   ///< Found no room in the system's buffers.
  double first_mb = 0;     ///< The tracker's memory soon after the start of the flood …
  double last_mb = 0;      ///< … and at its end.
  double oldest_ms = 0;    ///< Age of the newest event of an estimate, at most, meanwhile.
  double recovery_ms = 0;  ///< From the end until no estimate is older than 10 ms.
};

/// What is measured with the services running; what was not measured is missing.
struct LiveFigures {
  std::string recording;  ///< Of the transport's runs.
  std::vector<TransportRun> transport;
  std::vector<TransportRun> network_transport;  ///< With the camera on another machine.
  std::optional<LatencySummary> network_packet_to_estimate;
  std::vector<KeyCost> key;                          ///< Large packets, and those of one frame.
  std::optional<double> estimate_rate_hz;            ///< At the default limit.
  std::optional<double> estimate_rate_unlimited_hz;  ///< Without one.
  std::optional<LatencySummary>
      machine_wake;  ///< Of a thread by another one, nothing else running.
  std::optional<LatencySummary> packet_to_estimate;
  std::optional<LatencySummary> sensor_to_estimate;
  std::optional<LatencySummary> backlog;
  CpuLoad cpu_at_1_mev_s;
  std::optional<double> still_scene_cpu_percent;  ///< Tracker and camera together, of a core.
  CpuLoad still_scene_cpu;
  double still_scene_camera_wake_ups_hz = 0;
  double still_scene_tracker_wake_ups_hz = 0;
  bool still_scene_tracked = false;
  std::optional<LatencySummary> wake;
  std::optional<FloodRun> flood;
};

/// The highest rate of the runs, from the lowest on, at which nothing was lost: as it was asked
/// for, or, where the camera missed that pace, as it was sent; 0: none.
double highest_lossless_mev_s(const std::vector<TransportRun>& runs);

void print(const LiveFigures& figures);

/// Throws std::runtime_error when the file cannot be written.
void write_json(const LiveFigures& figures, const std::filesystem::path& path);

}  // namespace puck
