#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "services/logger/log_names.h"

namespace puck {

/// What the quota did.
struct QuotaResult {
  std::int64_t files_removed = 0;
  std::int64_t bytes_left = 0;  ///< Of the rotated files that are there now.
  std::string problem;          ///< Why it could not do all that it should; empty when it did.
};

/// Removes the oldest rotated logs of these names until the others take no more than `bytes`. Never
/// one that a logger writes, and nothing that is not a log by its name and by its first bytes.
QuotaResult remove_oldest_logs(const LogNames& names, std::int64_t bytes);

}  // namespace puck
