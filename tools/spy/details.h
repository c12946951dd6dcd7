#pragma once

#include <cstddef>

#include "common/monitor/bus_snapshot.h"
#include "tools/spy/screen.h"

namespace puck {

/// Details of a channel: its row, its publishers, the last rejection, and its newest message
/// decoded. Any number of lines, each `width` characters at most.
Screen channel_details(const ChannelRow& channel, std::size_t width);

/// Details of a service: its row, state text, latencies and counters.
Screen service_details(const ServiceRow& service, std::size_t width);

/// Style of a row.
LineStyle style_of(const ChannelRow& channel);
LineStyle style_of(const ServiceRow& service);

}  // namespace puck
