#pragma once

#include <vector>

#include "common/monitor/bus_snapshot.h"

namespace puck {

enum class ChannelSort { kFlow, kMessages, kBytes, kReceived, kLost, kMalformed, kAge };

/// The next order; after the last, the first.
ChannelSort next_sort(ChannelSort sort);
/// Text for the screen: `msg/s`.
const char* to_string(ChannelSort sort);

/// kFlow keeps the order of the data flow: EVENTS, ESTIMATE, …; all others put the largest first.
/// Stable.
std::vector<ChannelRow> sorted(std::vector<ChannelRow> channels, ChannelSort sort, bool reverse);

}  // namespace puck
