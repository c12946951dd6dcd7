#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/vision/truth_row.h"
#include "puck/game_state_t.hpp"
#include "puck/ground_truth_t.hpp"
#include "puck/puck_estimate_t.hpp"

namespace puck {

/// As a service summed it up over its whole run.
struct LoggedLatency {
  std::int64_t p50_us = 0;
  std::int64_t p99_us = 0;
  std::int64_t max_us = 0;
};

/// What a log of a game says that a report needs.
struct GameLog {
  std::vector<puck_estimate_t> estimates;
  std::vector<TruthRow> truth;
  std::optional<ground_truth_t> last_truth;
  std::optional<game_state_t> last_game;
  /// The newest counters of each service, by its name and theirs.
  std::map<std::string, std::map<std::string, std::int64_t>> counters;
  /// The same of latencies that have samples.
  std::map<std::string, std::map<std::string, LoggedLatency>> latencies;
  std::int64_t rejected = 0;  ///< Messages on our channels that are malformed.

  std::optional<std::int64_t> counter(const std::string& service, const std::string& name) const;
  std::optional<LoggedLatency> latency(const std::string& service, const std::string& name) const;
};

/// Of the channels under a prefix. Throws LogFileError when there is no such log or it is no log.
GameLog read_game_log(const std::filesystem::path& path, const std::string& prefix = "");

}  // namespace puck
