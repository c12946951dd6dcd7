#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "services/logger/log_names.h"

namespace puck {

/// Result of enforcing the quota.
struct QuotaResult {
  std::int64_t files_removed = 0;
  std::int64_t bytes_left = 0;  ///< Size of the remaining rotated files.
  std::string problem;          ///< Reason if the quota could not be enforced; else empty.
};

/// Removes the oldest rotated logs of these names until the rest takes at most `bytes`. Never
/// removes a log that is being written, or a file that is no log by its name and first bytes.
QuotaResult remove_oldest_logs(const LogNames& names, std::int64_t bytes);

}  // namespace puck
