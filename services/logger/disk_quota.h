#pragma once

#include <cstdint>
#include <filesystem>

#include "services/logger/log_names.h"

namespace puck {

/// What the quota did.
struct QuotaResult {
  std::int64_t files_removed = 0;
  std::int64_t bytes_left = 0;  ///< Of the rotated files that are there now.
};

/// Removes the oldest rotated logs of these names until the others take no more than `bytes`. Never
/// one that a logger writes, and nothing that is not a log by its name and by its first bytes.
QuotaResult remove_oldest_logs(const LogNames& names, std::int64_t bytes);

/// What a user may still fill of the disk that holds `folder`; 0 when it cannot be told.
std::int64_t free_bytes(const std::filesystem::path& folder);

}  // namespace puck
