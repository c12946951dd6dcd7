#pragma once

#include <string>

#include "tools/spy/screen.h"
#include "tools/spy/snapshot.h"

namespace puck {

/// The tables of channels and services on so many lines. Where there are more rows than lines, the
/// heads say so, and the rows around the selected one are shown.
Screen draw_overview(const Snapshot& snapshot, const std::string& selected, ScreenSize size);

/// A row's name that no other row has and that lasts while rows come, go and change places.
std::string row_id(const ChannelRow& channel);
std::string row_id(const ServiceRow& service);

}  // namespace puck
