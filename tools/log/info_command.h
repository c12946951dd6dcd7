#pragma once

#include <filesystem>

#include "tools/log/log_messages.h"

namespace puck {

/// Prints a summary of a log, as a table or as JSON. Throws LogFileError.
LogTally print_log_info(const std::filesystem::path& path, bool as_json);

}  // namespace puck
