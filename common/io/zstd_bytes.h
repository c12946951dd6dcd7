#pragma once

#include <memory>

#include "common/io/byte_source.h"

namespace puck {

/// Unpacks Zstandard, of one or more frames, with a window of up to 128 MiB.
std::unique_ptr<ByteSource> open_zstd_bytes(std::unique_ptr<ByteSource> packed);

}  // namespace puck
