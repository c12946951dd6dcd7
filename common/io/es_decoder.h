#pragma once

#include <optional>

#include "common/io/stream_start.h"

namespace puck {

/// The start of an Event Stream 2.0 file of a DVS or an ATIS: 5 bytes an event, the first with the
/// time since the last event, polarity and, of an ATIS, whether it is a grey level's, which is
/// skipped; then x and y in 16 bits each. y counts upwards in the file. As find_stream_start.
std::optional<StreamStart> begin_es(const StreamHead& head);

}  // namespace puck
