#pragma once

#include <cstddef>
#include <string>

#include "common/monitor/bus_snapshot.h"

namespace puck {

/// A JSON document: `channels`, `publishers`, `services` and `foreign` are arrays of flat objects,
/// with units in the names. Each counter and latency of a service is a key: `counter_events_sent`,
/// `latency_packet_to_estimate_p50_us`.
std::string json_report(const BusSnapshot& snapshot, const std::string& url,
                        const std::string& prefix);

/// The same as tables, `width` characters a line at most; without empty tables.
std::string text_report(const BusSnapshot& snapshot, std::size_t width);

}  // namespace puck
