#pragma once

#include <cstddef>
#include <string>

#include "common/messaging/transport.h"
#include "common/monitor/bus_snapshot.h"
#include "tools/spy/screen.h"

namespace puck {

/// The keys and the columns.
Screen help_page();

/// Foreign traffic on this group and port.
Screen others_page(const BusSnapshot& snapshot, std::size_t width);
/// Summary in one line.
ScreenLine others_line(const TransportCounters& network);

/// Shown before the first message. `waiting_for`: why it does not listen yet, or empty.
Screen silence_page(const std::string& waiting_for, const TransportCounters& network,
                    std::size_t width);

}  // namespace puck
