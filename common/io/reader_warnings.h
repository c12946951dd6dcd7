#pragma once

#include <string>
#include <vector>

#include "common/io/event_decoder.h"

namespace puck {

/// The lines that tell a person what was wrong with a file or stream called `name`: nothing for one
/// that was clean. `is_complete`: it was read to its end.
std::vector<std::string> reader_warnings(const std::string& name, const EventCounters& counters,
                                         bool is_complete);

}  // namespace puck
