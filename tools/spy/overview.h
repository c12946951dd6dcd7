#pragma once

#include <string>

#include "common/monitor/bus_snapshot.h"
#include "tools/spy/screen.h"

namespace puck {

/// The tables of channels and services. If the rows do not fit, the heads say so, and the rows
/// around the selected one are shown.
Screen draw_overview(const BusSnapshot& snapshot, const std::string& selected, ScreenSize size);

/// Unique and stable name of a row.
std::string row_id(const ChannelRow& channel);
std::string row_id(const ServiceRow& service);

}  // namespace puck
