#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/runtime/latency_histogram.h"
#include "tests/bench/live/live_system.h"

namespace puck {

/// A run at one rate: sent events, and their fate.
struct TransportRun {
  double wanted_mev_s = 0;
  double sent_mev_s = 0;  ///< Actual rate, by the host's clock.
  std::int64_t events_sent = 0;
  std::int64_t lost_on_the_way = 0;     ///< Sent but not received.
  std::int64_t counted_by_tracker = 0;  ///< Lost, from gaps in the packets' numbers.
  std::int64_t skipped = 0;             ///< Received too late, and dropped by the tracker.
  std::int64_t thinned = 0;             ///< On the surface, but not in the contour filter.
  std::int64_t late_us = 0;             ///< The camera's delay against the sensor's pace.
  CpuLoad cpu;

  std::int64_t lost() const { return lost_on_the_way + skipped; }
  bool lost_nothing() const { return lost() == 0 && counted_by_tracker == 0; }
  /// Whether the camera sent at the requested rate.
  bool kept_pace() const;
  /// Whether a higher rate is worth a try.
  bool carried_all() const { return lost_nothing() && kept_pace(); }
};

/// Cost of sealing all messages with a key.
struct KeyCost {
  struct Side {
    /// Of a core, all services together, scaled from the sent to the requested rate; of the best
    /// run. 0: none yet.
    double cpu_percent = 0;
    std::int64_t lost = 0;  ///< Events, in all runs.

    void add(const TransportRun& run);
  };

  double rate_mev_s = 0;
  int packet_bytes = 0;
  Side plain;
  Side sealed;

  /// Additional cost of the key.
  double percent() const { return 100 * (sealed.cpu_percent / plain.cpu_percent - 1); }
};

/// The tracker under more events than it can process.
struct FloodRun {
  double sent_mev_s = 0;
  double taken_mev_s = 0;  ///< Applied to the surface.
  std::int64_t skipped = 0;
  std::int64_t lost = 0;   ///< Found no room in the system's buffers.
  double first_mb = 0;     ///< The tracker's memory soon after the start of the flood …
  double last_mb = 0;      ///< … and at its end.
  double oldest_ms = 0;    ///< Largest age of an estimate's newest event meanwhile.
  double recovery_ms = 0;  ///< From the end until no estimate is older than 10 ms.
};

/// Figures measured with the services running; unmeasured ones are missing.
struct LiveFigures {
  std::string recording;  ///< Of the transport's runs.
  std::vector<TransportRun> transport;
  std::vector<TransportRun> busy;               ///< The game at its own speed with many events.
  std::vector<TransportRun> network_transport;  ///< With the camera on another machine.
  std::optional<LatencySummary> network_packet_to_estimate;
  std::vector<KeyCost> key;                          ///< Large packets, and those of one frame.
  std::optional<double> estimate_rate_hz;            ///< At the default limit.
  std::optional<double> estimate_rate_unlimited_hz;  ///< Without a limit.
  std::optional<LatencySummary> machine_wake;  ///< Of a thread by another one, on an idle machine.
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

/// The highest rate without loss, counted up from the lowest one: the requested rate, or the sent
/// rate where the camera was slower; 0: none.
double highest_lossless_mev_s(const std::vector<TransportRun>& runs);

void print(const LiveFigures& figures);

/// Throws std::runtime_error when the file cannot be written.
void write_json(const LiveFigures& figures, const std::filesystem::path& path);

}  // namespace puck
