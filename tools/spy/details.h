#pragma once

#include <cstddef>

#include "tools/spy/screen.h"
#include "tools/spy/snapshot.h"

namespace puck {

/// All about one channel: its row, its publishers, why a message was malformed, and its newest
/// message decoded. As many lines as it takes, each `width` characters at most.
Screen channel_details(const ChannelRow& channel, std::size_t width);

/// All about one service: its row, its last words, latencies and counters.
Screen service_details(const ServiceRow& service, std::size_t width);

/// How a row is drawn.
LineStyle style_of(const ChannelRow& channel);
LineStyle style_of(const ServiceRow& service);

}  // namespace puck
