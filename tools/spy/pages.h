#pragma once

#include <cstddef>
#include <string>

#include "common/messaging/transport.h"
#include "tools/spy/screen.h"
#include "tools/spy/snapshot.h"

namespace puck {

/// The keys, and what the columns mean.
Screen help_page();

/// What others send at this group and port.
Screen others_page(const Snapshot& snapshot, std::size_t width);
/// The same in a line.
ScreenLine others_line(const TransportCounters& network);

/// For as long as nothing has come. `waiting_for`: why it does not listen yet, if so.
Screen silence_page(const std::string& waiting_for, const TransportCounters& network,
                    std::size_t width);

}  // namespace puck
