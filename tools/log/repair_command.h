#pragma once

#include <filesystem>

#include "tools/log/log_messages.h"

namespace puck {

/// Copies valid messages, and all messages on other channels, into a new log, and prints what is
/// left out and where. Throws LogFileError, also if `output` exists.
LogTally repair_log(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace puck
