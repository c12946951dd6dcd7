#pragma once

#include <chrono>

#include "tests/bench/live/live_figures.h"
#include "tests/bench/live/live_system.h"
#include "tests/bench/live/recordings.h"

namespace puck {

/// Each starts the services, lets them run and stops them. They throw std::runtime_error when a
/// service fails, Interrupted when the benchmark is stopped.

/// The camera sends events at a steady mean rate; what arrives is counted at the end.
TransportRun measure_transport(const LiveSetup& setup, const Recording& recording,
                               double rate_mev_s, std::chrono::seconds time);

/// At 1 Mev/s: the tracker's latencies.
void measure_latency(const LiveSetup& setup, const Recording& game, std::chrono::seconds time,
                     LiveFigures& figures);

/// How often the tracker publishes at 1 Mev/s that come in packets of 150 us, Hz.
double measure_rate(const LiveSetup& setup, const Recording& game, int max_publish_hz,
                    std::chrono::seconds time);

/// What a scene costs in which nothing moves, and how soon the tracker then wakes up.
void measure_still_scene(const LiveSetup& setup, const Recording& scene, std::chrono::seconds time,
                         LiveFigures& figures);

/// What becomes of the tracker while it gets events as fast as one process can send them, and how
/// soon it is at the newest again afterwards.
void measure_flood(const LiveSetup& setup, std::chrono::seconds time, LiveFigures& figures);

}  // namespace puck
