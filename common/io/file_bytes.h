#pragma once

#include <memory>
#include <string>

#include "common/io/byte_source.h"

namespace puck {

/// The bytes as they are stored; "-" is standard input. Throws EventFileError.
std::unique_ptr<ByteSource> open_file_bytes(const std::string& path);

}  // namespace puck
