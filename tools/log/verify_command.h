#pragma once

#include <filesystem>

#include "tools/log/log_messages.h"

namespace puck {

/// Prints every place of a log where something is wrong, with its offset, and a summary. Throws
/// LogFileError.
LogTally verify_log(const std::filesystem::path& path);

}  // namespace puck
