#pragma once

#include <vector>

#include "tools/spy/snapshot.h"

namespace puck {

enum class ChannelSort { kFlow, kMessages, kBytes, kReceived, kLost, kMalformed, kAge };

/// The one that comes next; after the last, the first.
ChannelSort next_sort(ChannelSort sort);
/// As it is said on the screen: `msg/s`.
const char* to_string(ChannelSort sort);

/// kFlow keeps the order of the data's way: EVENTS, ESTIMATE, …; all others put the largest first.
/// Equal ones stay in that order.
std::vector<ChannelRow> sorted(std::vector<ChannelRow> channels, ChannelSort sort, bool reverse);

}  // namespace puck
