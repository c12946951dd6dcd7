#pragma once

#include <optional>

#include "common/io/stream_start.h"

namespace puck {

/// The start of text with one event a line. Lines that begin with `#` or `%` are comments, except
/// `%geometry:WIDTH,HEIGHT`, which states the sensor's size. A line of column names, such as
/// `x,y,p,t`, overrides the order in the options; other columns are ignored. Times are rounded to
/// whole µs; polarity is 1 for brighter and 0 or −1 for darker. Numbers may be written with
/// decimals or an exponent. As find_stream_start.
std::optional<StreamStart> begin_text(const StreamHead& head);

}  // namespace puck
