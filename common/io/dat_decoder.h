#pragma once

#include <optional>

#include "common/io/stream_start.h"

namespace puck {

/// The start of a Prophesee DAT file, versions 1 and 2: `% key value` lines, a byte that tells the
/// kind of the records and one that tells their size, and records of eight bytes: a 32-bit time in
/// µs, which wraps after 71.6 minutes, and x, y and polarity in 14, 14 and 4 bits (version 1: 9, 8
/// and 1). As find_stream_start.
std::optional<StreamStart> begin_dat(const StreamHead& head);

}  // namespace puck
