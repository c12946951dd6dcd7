#pragma once

#include <chrono>

#include "tests/bench/live/live_figures.h"
#include "tests/bench/live/live_system.h"
#include "tests/bench/live/recordings.h"

namespace puck {

inline constexpr int kSuitsTheBus = 0;

/// Each function starts the services, lets them run and stops them. It throws std::runtime_error
/// when a service fails, Interrupted when the benchmark is stopped.

/// The camera sends events at a steady mean rate; what arrives is counted at the end.
/// `packet_bytes`: key camera.packet_bytes.
TransportRun measure_transport(const LiveSetup& setup, const Recording& recording,
                               double rate_mev_s, std::chrono::seconds time,
                               int packet_bytes = kSuitsTheBus);

/// The same, and at 1 Mev/s from packet to estimate, with the camera on another machine: at each of
/// `rates_mev_s` until something is lost, the first for `sustained`, the others for `brief`. Throws
/// NoNetwork.
void measure_network(LiveSetup setup, const Recording& dense, const Recording& game,
                     const std::vector<double>& rates_mev_s, std::chrono::seconds sustained,
                     std::chrono::seconds brief, LiveFigures& figures);

/// Cost of sealing all messages with a key at this rate. `turns` times both without and with a key;
/// the best run of each counts.
KeyCost measure_key(LiveSetup setup, const Recording& recording, double rate_mev_s,
                    int packet_bytes, std::chrono::seconds time, int turns);

/// At 1 Mev/s: the tracker's latencies.
void measure_latency(const LiveSetup& setup, const Recording& game, std::chrono::seconds time,
                     LiveFigures& figures);

/// The tracker's publishing rate at 1 Mev/s in packets of 150 us, Hz.
double measure_rate(const LiveSetup& setup, const Recording& game, int max_publish_hz,
                    std::chrono::seconds time);

/// CPU load of a scene without motion, and the tracker's wake-up time after it.
void measure_still_scene(const LiveSetup& setup, const Recording& scene, std::chrono::seconds time,
                         LiveFigures& figures);

/// The tracker's state while it gets events as fast as one process can send them, and its recovery
/// time afterwards.
void measure_flood(const LiveSetup& setup, std::chrono::seconds time, LiveFigures& figures);

}  // namespace puck
