#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/io/event_decoder.h"

namespace puck {

/// Warnings about a file or stream called `name`, one a line; empty if it had no faults.
/// `is_complete`: it was read to its end. `bytes`: its length so far, if known.
std::vector<std::string> reader_warnings(const std::string& name, const EventCounters& counters,
                                         bool is_complete,
                                         std::optional<std::int64_t> bytes = std::nullopt);

/// Why the reading of a file counts as failed, though it has an end: more than 1 % of its events
/// were dropped by the reader.
std::optional<std::string> large_loss(const EventCounters& counters);

}  // namespace puck
