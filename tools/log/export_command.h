#pragma once

#include <filesystem>
#include <string>

#include "tools/log/log_messages.h"

namespace puck {

struct ExportOptions {
  std::filesystem::path folder;  ///< One CHANNEL.csv a channel into it; empty: to stdout.
  std::string channel;           ///< Only this one; empty: all.
};

/// Writes the messages of a log as CSV, a line each; what no receiver takes is left out. What it
/// did and what is wrong goes to stderr. Throws LogFileError, and std::runtime_error when a file
/// cannot be written or the channel is not there or not ours.
LogTally export_log(const std::filesystem::path& path, const ExportOptions& options);

}  // namespace puck
