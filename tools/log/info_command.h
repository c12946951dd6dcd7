#pragma once

#include <filesystem>

#include "tools/log/log_messages.h"

namespace puck {

/// Prints what a log holds, as a table or, for scripts, as JSON. Throws LogFileError.
LogTally print_log_info(const std::filesystem::path& path, bool as_json);

}  // namespace puck
