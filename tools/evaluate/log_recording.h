#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/vision/truth_row.h"

namespace puck {

/// Whether a file is a log of LCM, by its first bytes. False where there is no such file.
bool is_lcm_log(const std::filesystem::path& path);

/// The run of the publisher whose events these are. Throws LogFileError.
std::int64_t session_of_event_log(const std::filesystem::path& path, const std::string& prefix);

/// The truth that a log of the simulated table holds on PUCK_TRUTH; none where the world was real.
std::vector<TruthRow> read_truth_log(const std::filesystem::path& path,
                                     const std::string& prefix = "");

}  // namespace puck
