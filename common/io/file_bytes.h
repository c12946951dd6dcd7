#pragma once

#include <memory>
#include <string>

#include "common/io/byte_source.h"

namespace puck {

/// The bytes as they are stored. As open_bytes.
std::unique_ptr<ByteSource> open_file_bytes(const std::string& path,
                                            const Interruption* interruption);

}  // namespace puck
