#pragma once

#include <filesystem>
#include <string>

#include "tools/log/log_messages.h"

namespace puck {

struct ExportOptions {
  std::filesystem::path folder;  ///< For one CHANNEL.csv per channel; empty: to stdout.
  std::string channel;           ///< The only one to export; empty: all.
};

/// Writes the valid messages of a log as CSV, one line each. Counts and defects go to stderr.
/// Throws LogFileError, and std::runtime_error if a file cannot be written or the channel is
/// missing or not a PUCK channel.
LogTally export_log(const std::filesystem::path& path, const ExportOptions& options);

}  // namespace puck
