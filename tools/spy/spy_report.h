#pragma once

#include <cstddef>
#include <string>

#include "tools/spy/snapshot.h"

namespace puck {

/// One JSON document for scripts: `channels`, `publishers`, `services` and `foreign` are arrays of
/// flat objects, with the units in the names. Counters and latencies of services are keys of their
/// own: `counter_events_sent`, `latency_packet_to_estimate_p50_us`.
std::string json_report(const Snapshot& snapshot, const std::string& url,
                        const std::string& prefix);

/// The same as tables for a person, `width` characters a line at most; empty tables are left out.
std::string text_report(const Snapshot& snapshot, std::size_t width);

}  // namespace puck
