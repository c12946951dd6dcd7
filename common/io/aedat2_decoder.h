#pragma once

#include <optional>

#include "common/io/stream_start.h"

namespace puck {

/// The start of an AER-DAT 2.0 file: lines of text that begin with `#`, the last of which may be
/// `#End Of ASCII Header`, then pairs of a 32-bit address and a 32-bit time in µs, big-endian. The
/// addresses of the DVS128, the DAVIS240 and the DAVIS346 are known; the header names the camera,
/// else the sensor's size in the options tells it, else small addresses are a DVS128's. The DVS128
/// is read as jAER reads it, which recorded such files: bit 0 is 0 for ON, and both axes are
/// reversed. As find_stream_start.
std::optional<StreamStart> begin_aedat2(const StreamHead& head);

}  // namespace puck
