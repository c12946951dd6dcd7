#pragma once

#include <optional>

#include "common/io/stream_start.h"

namespace puck {

/// The start of Prophesee RAW data: EVT 2.0, 2.1, 3.0 or 4.0, with or without a header. As
/// find_stream_start.
std::optional<StreamStart> begin_raw(const StreamHead& head);

}  // namespace puck
