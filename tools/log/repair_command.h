#pragma once

#include <filesystem>

#include "tools/log/log_messages.h"

namespace puck {

/// Copies what receivers take, and messages on channels that are not ours as they are, into a new
/// log, and prints what it left out and where. Throws LogFileError; so it does when `output`
/// exists.
LogTally repair_log(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace puck
