#pragma once

#include <filesystem>

#include "tools/log/log_messages.h"

namespace puck {

/// Prints each defect of a log with its byte offset, and a summary. Throws LogFileError.
LogTally verify_log(const std::filesystem::path& path);

}  // namespace puck
