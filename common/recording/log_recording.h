#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/vision/geometry/truth_row.h"

namespace puck {

/// Recognises an LCM log by its first bytes. False if the file does not exist.
bool is_lcm_log(const std::filesystem::path& path);

/// Session of the publisher of the log's events. Throws LogFileError.
std::int64_t session_of_event_log(const std::filesystem::path& path, const std::string& prefix);

/// The truth on PUCK_TRUTH in a log of the simulated table; empty for a real one.
std::vector<TruthRow> read_truth_log(const std::filesystem::path& path,
                                     const std::string& prefix = "");

}  // namespace puck
