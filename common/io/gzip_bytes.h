#pragma once

#include <memory>

#include "common/io/byte_source.h"

namespace puck {

/// Unpacks gzip, of one or more parts.
std::unique_ptr<ByteSource> open_gzip_bytes(std::unique_ptr<ByteSource> packed);

}  // namespace puck
